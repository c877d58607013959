import type { Api } from '../../api/client'
import { discardUpload, openUpload, removeUploaded, sendFile } from '../../api/corpus_calls'
import { ApiError } from '../../api/fault'
import type { Listed } from './file_list'

const kTellMs = 100

/** How far a file is. */
export interface Sending {
  readonly state: 'sending' | 'sent' | 'failed'
  readonly bytes: number
  readonly name: string
  readonly fault?: unknown
}

/** Sends files to an upload of the server, one after the other. What was sent stays there while others fail or are cancelled. */
export class Sender {
  /** By the file's number; those that wait are not there. */
  told = $state.raw<ReadonlyMap<number, Sending>>(new Map())
  busy = $state(false)
  upload = $state<string | undefined>()
  private abort?: AbortController

  constructor(
    private readonly api: Api,
    private readonly database: string,
  ) {}

  bytes(): number {
    return [...this.told.values()].reduce((sum, { bytes }) => sum + bytes, 0)
  }
  has({ id, name }: Listed): boolean {
    const told = this.told.get(id)
    return told?.state === 'sent' && told.name === name
  }
  /** Takes back what was sent and is not among `files` any more, or has another name now: the server would read it. The rest stays there. */
  async retract(files: readonly Listed[]): Promise<void> {
    const names = new Map(files.map(({ id, name }) => [id, name]))
    for (const [id, { state, name }] of this.told) {
      if (state !== 'sent' || names.get(id) === name) continue
      try {
        await removeUploaded(this.api, this.database, this.upload!, name)
      } catch (fault) {
        if (!(fault instanceof ApiError && fault.status === 404) || isGone(fault)) throw fault
      }
      this.untold(id)
    }
  }

  /** Sends what is not there yet; true where all of it is there then. */
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

  /** A small file that is made here, such as a table. */
  async put(name: string, text: string): Promise<void> {
    await sendFile(this.api, this.database, this.upload!, name, new Blob([text]), () => {}, new AbortController().signal)
  }

  cancel(): void {
    this.abort?.abort(new DOMException('cancelled', 'AbortError'))
  }

  /** Gives up the upload: what was sent has to be sent again. */
  forget(): void {
    const { upload } = this
    this.cancel()
    this.upload = undefined
    this.told = new Map()
    if (upload) discardUpload(this.api, this.database, upload).catch(() => {}) // it goes by itself when nobody uses it
  }

  private untold(id: number): void {
    const rest = new Map(this.told)
    rest.delete(id)
    this.told = rest
  }

  private async one({ id, name, file }: Listed, signal: AbortSignal): Promise<void> {
    let last = 0
    const tell = (sending: Sending) => (this.told = new Map(this.told).set(id, sending))
    tell({ state: 'sending', bytes: 0, name })
    try {
      await sendFile(
        this.api,
        this.database,
        this.upload!,
        name,
        file,
        (loaded) => {
          const now = performance.now()
          if (now - last < kTellMs) return
          last = now
          tell({ state: 'sending', bytes: Math.min(loaded, file.size), name })
        },
        signal,
      )
      tell({ state: 'sent', bytes: file.size, name })
    } catch (fault) {
      if (signal.aborted) {
        this.untold(id)
        return
      }
      if (isGone(fault)) throw fault
      tell({ state: 'failed', bytes: 0, name, fault })
    }
  }
}

/** Whether the server has the upload no more: nobody used it for an hour, or the server was started anew. */
export const isGone = (fault: unknown) => fault instanceof ApiError && fault.status === 404 && /no upload/.test(fault.message)
