import type { Api, PieceOptions } from '../api/client'
import type { MotionSource, OpenedMotion } from './source'
import { wholeMotion } from './whole_motion'

/** A short piece of a recording, fetched at once; its frame 0 is the first of the piece. */
export class PieceSource implements MotionSource {
  readonly grows = false
  complete = false
  onProgress?: (complete: boolean) => void
  onFault?: (fault: Error) => void
  private readonly abort = new AbortController()

  /** `title` is the name on the screen. */
  constructor(
    private readonly api: Api,
    private readonly database: string,
    private readonly recording: string,
    private readonly options: PieceOptions,
    readonly title = recording,
  ) {}

  async open(): Promise<OpenedMotion> {
    const { api, database, recording, options, abort } = this
    const opened = await wholeMotion((taker) => api.piece(database, recording, options, taker, abort.signal))
    this.complete = true
    return opened
  }

  close(): void {
    this.abort.abort()
  }
}
