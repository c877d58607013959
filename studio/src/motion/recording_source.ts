import { rigOf, type Api, type RecordingInfo } from '../api/client'
import { StudioFault } from '../api/fault'
import { FrameStore } from './frame_store'
import { Pieces, type Piece } from './pieces'
import type { MotionSource, OpenedMotion } from './source'

/** Seconds of the first piece: short, so that the first picture does not wait; the pieces then grow. */
const kFirstPiece = 0.25
const kLongestPiece = 4

/** The frames [first, end) that should be asked for next. */
export function nextPiece(missing: number, length: number, rate: number, pieces: number): { first: number; end: number } {
  const seconds = Math.min(kLongestPiece, kFirstPiece * 2 ** pieces)
  return { first: missing, end: Math.min(length, missing + Math.max(1, Math.round(seconds * rate))) }
}

/** A recording, fetched in pieces: first around where the picture is, then all the rest. */
export class RecordingSource implements MotionSource {
  readonly title: string
  readonly grows = false
  complete = false
  onProgress?: (complete: boolean) => void
  onFault?: (fault: Error) => void
  private readonly pieces = new Pieces()
  private wanted = 0
  private closed = false

  constructor(private readonly api: Api, private readonly database: string, private readonly recording: string,
              private readonly info: Promise<RecordingInfo>, startSeconds = 0) {
    this.title = recording
    this.wanted = startSeconds
  }

  async open(): Promise<OpenedMotion> {
    const info = await this.info
    const rate = info.frames_per_second
    const start = Math.min(Math.max(0, Math.floor(this.wanted * rate)), Math.max(0, info.frames - 1))
    const { first, end } = nextPiece(start, info.frames, rate, 0)
    const piece = await this.piece(info, first, end)
    const store = new FrameStore(piece.skeleton, rate, rigOf(info), info.frames)
    store.put({ ...piece, offset: 0 })
    void this.rest(info, store)
    return { store, rig: rigOf(info), originMs: info.clock_origin_ms, declarations: piece.declarations, recording: this.recording }
  }

  want(seconds: number): void {
    this.wanted = seconds
  }

  close(): void {
    this.closed = true
    this.pieces.close()
  }

  private async rest(info: RecordingInfo, store: FrameStore): Promise<void> {
    for (let pieces = 1, faults = 0; store.arrived < store.length; ++pieces) {
      let missing = store.firstMissing(Math.floor(this.wanted * store.rate))
      if (missing >= store.length) missing = store.firstMissing(0)
      const { first, end } = nextPiece(missing, store.length, store.rate, pieces)
      try {
        const piece = await this.piece(info, first, end)
        if (this.closed) return
        const before = store.arrived
        store.put({ ...piece, offset: 0 })
        // An answer that brings nothing new would be asked for again, for ever.
        if (store.arrived === before) throw new StudioFault('framesMissing', `${first}–${end}`)
        faults = 0
        this.onProgress?.(store.arrived >= store.length)
      } catch (fault) {
        if (this.closed) return
        if (++faults === 3) return this.onFault?.(fault as Error)
        await new Promise((resolve) => setTimeout(resolve, 300 * faults))
        if (this.closed) return
      }
    }
    this.complete = true
    this.pieces.close()
    this.onProgress?.(true)
  }

  private async piece(info: RecordingInfo, first: number, end: number): Promise<Piece> {
    const ms = (frame: number) => Math.round(info.clock_origin_ms + (1000 * frame) / info.frames_per_second)
    const url = this.api.motionUrl(this.database, this.recording, ms(first), ms(end))
    return this.pieces.fetch(url, first, { method: 'GET', headers: this.api.headers() })
  }
}
