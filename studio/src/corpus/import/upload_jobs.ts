import type { Api } from '../../api/client'
import { beginUpload, cancelJob } from '../../api/corpus_calls'
import { ApiError } from '../../api/fault'
import type { Listed } from './file_list'
import { isGone, type Sender } from './sender.svelte'

/** A call of an upload: its parameters, and the small files generated for it, keyed by the parameter that refers to each. */
export interface UploadCall {
  readonly parameters: Readonly<Record<string, unknown>>
  readonly made: Readonly<Record<string, { readonly name: string; readonly text: string }>>
}

/** The current activity; `part` is its progress, 0 to 1. */
export interface Doing {
  readonly what: 'inspect' | 'import'
  readonly part: number
  /** For an import, the recordings of the current call in their order, and its progress. */
  readonly call?: { readonly keys: readonly string[]; readonly part: number }
}

/** Runs the calls of an upload, one at a time; if the server no longer has the upload, everything is sent again first. */
export class UploadJobs {
  private job?: string
  private isStopped = false

  /** `files` are those that the upload must contain. */
  constructor(
    private readonly api: Api,
    private readonly database: string,
    private readonly sender: Sender,
    private readonly files: () => readonly Listed[],
  ) {}

  async run<Result>(what: 'inspect' | 'import', call: () => UploadCall, onprogress: (part: number, result?: Result) => void): Promise<Result> {
    this.isStopped = false
    try {
      if (!this.sender.upload) await this.sendAgain()
      return await this.once(what, call(), onprogress)
    } catch (fault) {
      if (!isGone(fault)) throw fault
      await this.sendAgain()
      return this.once(what, call(), onprogress)
    }
  }
  /** Also works while the job is about to start. */
  async cancel(): Promise<void> {
    this.isStopped = true
    if (this.job) await cancelJob(this.api, this.job)
  }

  private async sendAgain(): Promise<void> {
    this.sender.forget()
    if (await this.sender.send(this.files())) return
    const fault = [...this.sender.states.values()].find(({ state }) => state === 'failed')?.fault
    throw fault instanceof Error ? fault : cancelled()
  }

  private async once<Result>(
    what: 'inspect' | 'import',
    { parameters, made }: UploadCall,
    onprogress: (part: number, result?: Result) => void,
  ): Promise<Result> {
    const { api, database, sender } = this,
      body = { ...parameters }
    await sender.retract(this.files())
    for (const [parameter, { name, text }] of Object.entries(made)) {
      await sender.put(name, text)
      body[parameter] = name
    }
    if (this.isStopped) throw cancelled()
    const begun = await beginUpload(api, database, sender.upload!, what, body)
    this.job = begun.job
    try {
      if (this.isStopped) await this.cancel()
      const result = await api.result<Result>(begun, (state) => onprogress(state.fraction, state.result))
      onprogress(1, result)
      return result
    } finally {
      this.job = undefined
    }
  }
}

const cancelled = () => new ApiError('cancelled', 503, 'cancelled')
