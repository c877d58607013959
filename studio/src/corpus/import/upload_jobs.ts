import type { Api } from '../../api/client'
import { beginUpload, cancelJob } from '../../api/corpus_calls'
import { ApiError } from '../../api/fault'
import type { Listed } from './file_list'
import { isGone, type Sender } from './sender.svelte'

/** A call of an upload: its parameters, and the small files that are made for it, by the parameter that names each. */
export interface UploadCall { readonly parameters: Readonly<Record<string, unknown>>; readonly made: Readonly<Record<string, { readonly name: string; readonly text: string }>> }

/** Does the calls of an upload, one at a time; where the server has the upload no more, everything is sent again first. */
export class UploadJobs {
  private job?: string

  /** `files` are those that the upload has to have. */
  constructor(private readonly api: Api, private readonly database: string, private readonly sender: Sender, private readonly files: () => readonly Listed[]) {}

  async run<Result>(what: 'inspect' | 'import', call: () => UploadCall, told: (part: number, result?: Result) => void): Promise<Result> {
    try {
      if (!this.sender.upload) await this.sendAgain()
      return await this.once(what, call(), told)
    } catch (fault) {
      if (!isGone(fault)) throw fault
      await this.sendAgain()
      return this.once(what, call(), told)
    }
  }
  async cancel(): Promise<void> {
    if (this.job) await cancelJob(this.api, this.job)
  }

  private async sendAgain(): Promise<void> {
    this.sender.forget()
    if (await this.sender.send(this.files())) return
    throw [...this.sender.told.values()].find(({ state }) => state === 'failed')?.fault ?? new ApiError('cancelled', 503, 'cancelled')
  }

  private async once<Result>(what: 'inspect' | 'import', { parameters, made }: UploadCall, told: (part: number, result?: Result) => void): Promise<Result> {
    const { api, database, sender } = this, body = { ...parameters }
    for (const [parameter, { name, text }] of Object.entries(made)) {
      await sender.put(name, text)
      body[parameter] = name
    }
    const begun = await beginUpload(api, database, sender.upload!, what, body)
    this.job = begun.job
    try {
      const result = await api.result<Result>(begun, (state) => told(state.fraction, state.result))
      told(1, result)
      return result
    } finally {
      this.job = undefined
    }
  }
}
