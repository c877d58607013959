import type { Api } from '../../api/client'
import { discardUpload, openUpload, removeUploaded, sendFile } from '../../api/corpus_calls'
import { ApiError } from '../../api/fault'
import type { Listed } from './file_list'

const kUpdateMs = 100

/** The progress of a file. */
export interface Sending {
  readonly state: 'sending' | 'sent' | 'failed'
  readonly bytes: number
  readonly name: string
  readonly fault?: unknown
}

/** Sends files to an upload of the server, one after the other. Sent files stay there while others fail or are cancelled. */
export class Sender {
  /** By the file's id; waiting files have no entry. */
  states = $state.raw<ReadonlyMap<number, Sending>>(new Map())
  busy = $state(false)
  upload = $state<string | undefined>()
  private abort?: AbortController

  constructor(
    private readonly api: Api,
    private readonly database: string,
  ) {}

  bytes(): number {
    return [...this.states.values()].reduce((sum, { bytes }) => sum + bytes, 0)
  }
  has({ id, name }: Listed): boolean {
    const own = this.states.get(id)
    return own?.state === 'sent' && own.name === name
  }
  /** Removes sent files that are no longer among `files`, or have another name now: the server would read them. The rest stays there. */
  async retract(files: readonly Listed[]): Promise<void> {
    const names = new Map(files.map(({ id, name }) => [id, name]))
    for (const [id, { state, name }] of this.states) {
      if (state !== 'sent' || names.get(id) === name) continue
      try {
        await removeUploaded(this.api, this.database, this.upload!, name)
      } catch (fault) {
        if (!(fault instanceof ApiError && fault.status === 404) || isGone(fault)) throw fault
      }
      this.clearState(id)
    }
  }

  /** Sends the files that are not there yet; returns true if all of them are there afterwards. */
  async send(files: readonly Listed[]): Promise<boolean> {
    this.abort = new AbortController()
    const { signal } = this.abort
    this.busy = true
    try {
      this.upload ??= await openUpload(this.api, this.database)
      await this.retract(files)
      for (const file of files) {
        if (this.has(file)) continue
        if (signal.aborted) return false
        await this.one(file, signal)
      }
      return files.every((file) => this.has(file))
    } finally {
      this.busy = false
    }
  }

  /** Sends a small file that is generated here, such as a table. */
  async put(name: string, text: string): Promise<void> {
    await sendFile(this.api, this.database, this.upload!, name, new Blob([text]), () => {}, new AbortController().signal)
  }

  cancel(): void {
    this.abort?.abort(new DOMException('cancelled', 'AbortError'))
  }

  /** Discards the upload: all files have to be sent again. */
  forget(): void {
    const { upload } = this
    this.cancel()
    this.upload = undefined
    this.states = new Map()
    if (upload) discardUpload(this.api, this.database, upload).catch(() => {}) // the server removes it after a time without use
  }

  private clearState(id: number): void {
    const rest = new Map(this.states)
    rest.delete(id)
    this.states = rest
  }

  private async one({ id, name, file }: Listed, signal: AbortSignal): Promise<void> {
    let last = 0
    const update = (sending: Sending) => (this.states = new Map(this.states).set(id, sending))
    update({ state: 'sending', bytes: 0, name })
    try {
      await sendFile(
        this.api,
        this.database,
        this.upload!,
        name,
        file,
        (loaded) => {
          const now = performance.now()
          if (now - last < kUpdateMs) return
          last = now
          update({ state: 'sending', bytes: Math.min(loaded, file.size), name })
        },
        signal,
      )
      update({ state: 'sent', bytes: file.size, name })
    } catch (fault) {
      if (signal.aborted) {
        this.clearState(id)
        return
      }
      if (isGone(fault)) throw fault
      update({ state: 'failed', bytes: 0, name, fault })
    }
  }
}

/** Whether the server no longer has the upload: it was unused for an hour, or the server was restarted. */
export const isGone = (fault: unknown) => fault instanceof ApiError && fault.status === 404 && /no upload/.test(fault.message)
