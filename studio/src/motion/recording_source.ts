import { withMotion, type MovingRecording } from '../api/types'
import type { Api } from '../api/client'
import { StudioFault } from '../api/fault'
import { declarationsOf, frameBytes, skeletonOf } from './frames'
import { rigOf } from './frames_body'
import { FrameStore } from './frame_store'
import type { MotionSource, OpenedMotion } from './source'

/** Seconds of the first piece: short, so that the first frame does not wait; later pieces are longer. */
const kFirstPiece = 0.25
const kLongestPiece = 4
/** Seconds after the current time that are fetched before anything else. */
const kAhead = 20
/** Bytes of frames stored; of a longer recording, frames far from the current time are dropped and fetched again when needed. */
const kMostBytes = 160e6

/** Returns the frames [first, end) to request next. */
export function nextPiece(missing: number, length: number, rate: number, pieces: number): { first: number; end: number } {
  const seconds = Math.min(kLongestPiece, kFirstPiece * 2 ** pieces)
  return { first: missing, end: Math.min(length, missing + Math.max(1, Math.round(seconds * rate))) }
}

/** A recording, fetched in pieces: first around the current time, then all the rest. */
export class RecordingSource implements MotionSource {
  readonly title: string
  readonly grows = false
  complete = false
  onProgress?: (complete: boolean) => void
  onFault?: (fault: Error) => void
  private readonly abort = new AbortController()
  private wanted: number
  private moved?: () => void
  private info!: MovingRecording
  private opened?: OpenedMotion

  /** `character` names the character whose joints the poses are for; playback starts at `startSeconds` from frame 0. */
  constructor(
    private readonly api: Api,
    private readonly database: string,
    private readonly recording: string,
    private readonly character?: string,
    startSeconds = 0,
  ) {
    this.title = recording
    this.wanted = startSeconds
  }

  async open(): Promise<OpenedMotion> {
    this.info = withMotion(await this.api.recording(this.database, this.recording))
    const { frames, frames_per_second: rate } = this.info
    const start = Math.min(Math.max(0, Math.floor(this.wanted * rate)), Math.max(0, frames - 1))
    const { first, end } = nextPiece(start, frames, rate, 0)
    await this.fetch(first, end)
    const opened = this.opened!
    void this.rest(opened.store)
    return opened
  }

  want(seconds: number): void {
    this.wanted = seconds
    this.moved?.()
  }

  close(): void {
    this.abort.abort()
    this.moved?.()
  }

  private async rest(store: FrameStore): Promise<void> {
    const { signal } = this.abort
    for (let pieces = 1, faults = 0; !signal.aborted; ++pieces) {
      const missing = this.missing(store)
      if (missing === undefined) {
        await new Promise<void>((resolve) => (this.moved = resolve))
        continue
      }
      const { first, end } = nextPiece(missing, store.length, store.rate, pieces)
      try {
        await this.fetch(first, end)
        // An answer without new frames would be requested again endlessly.
        if (!store.has(first)) throw new StudioFault('framesMissing', `${first}–${end}`)
        faults = 0
        store.keepAround(Math.floor(this.wanted * store.rate), Math.floor(kMostBytes / frameBytes(store.skeleton)))
        this.complete = store.arrived >= store.length
        this.onProgress?.(this.complete)
      } catch (fault) {
        if (signal.aborted) return
        if (++faults === 3) return this.onFault?.(fault as Error)
        await new Promise((resolve) => setTimeout(resolve, 300 * faults))
      }
    }
  }

  /** Returns the frame to fetch next: one needed for playback soon, otherwise one that never arrived; undefined if all are loaded. */
  private missing(store: FrameStore): number | undefined {
    const at = Math.max(0, Math.floor(this.wanted * store.rate))
    const next = store.firstMissing(at)
    if (next < Math.min(store.length, at + kAhead * store.rate)) return next
    return store.arrived < store.length ? store.firstNew(next) : undefined
  }

  private async fetch(first: number, end: number): Promise<void> {
    const { info, database, recording, character } = this
    const ms = (frame: number) => Math.round(info.clock_origin_ms + (1000 * frame) / info.frames_per_second)
    let shift = 0
    await this.api.motion(
      database,
      recording,
      ms(first),
      ms(end),
      character,
      {
        begin: (header) => {
          // A piece counts its frames from its own first one.
          shift = Math.round(((header.origin_ms - info.clock_origin_ms) * info.frames_per_second) / 1000)
          if (this.opened) return
          const rig = rigOf(header)
          const store = new FrameStore(skeletonOf(header), header.rate, rig, info.frames)
          this.opened = { store, rig, character: header.character, originMs: info.clock_origin_ms, declarations: declarationsOf(header) }
        },
        take: (block) => this.opened!.store.put({ ...block, first: block.first + shift }),
      },
      this.abort.signal,
    )
  }
}
