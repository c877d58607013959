import { frameBytes } from './frames'
import type { MotionSource, OpenedMotion } from './source'

/** A piece of a recording, in ms of annotation time, in a character's joints if one is named. */
export interface Piece {
  readonly recording: string
  readonly from: number
  readonly to: number
  readonly character?: string
}
export const keyOf = ({ recording, from, to, character = '' }: Piece): string => `${from}..${to} ${character} ${recording}`

/** A loaded piece, or the fault that prevented it. */
export type Come =
  { readonly source: MotionSource; readonly motion: OpenedMotion; readonly fault?: undefined } | { readonly fault: unknown; readonly motion?: undefined }

const kAtOnce = 4
const kMostBytes = 48e6

/**
 * Fetches many short pieces of which some are visible: the set of wanted pieces is given as a whole, others in progress are cancelled, and fetched ones are
 * cached as long as there is room.
 */
export class Pieces {
  /** Called as soon as a wanted piece has loaded or failed. */
  onCome?: (key: string) => void
  private wanted = new Map<string, Piece>()
  private readonly going = new Map<string, MotionSource>()
  /** The least recently used first. */
  private readonly come = new Map<string, Come & { readonly bytes: number }>()
  private bytes = 0

  constructor(
    private readonly source: (piece: Piece) => MotionSource,
    private readonly most = kMostBytes,
  ) {}

  /** Sets the wanted pieces in the order in which they should arrive; all others in progress are cancelled. */
  want(pieces: readonly Piece[]): void {
    this.wanted = new Map(pieces.map((piece) => [keyOf(piece), piece]))
    for (const [key, source] of this.going) {
      if (this.wanted.has(key)) continue
      this.going.delete(key)
      source.close()
    }
    for (const key of this.wanted.keys()) {
      const here = this.come.get(key)
      if (!here) continue
      this.come.delete(key)
      this.come.set(key, here)
    }
    // A fault is reported as long as its piece is wanted; later the piece is fetched again.
    for (const [key, { fault }] of this.come) if (fault !== undefined && !this.wanted.has(key)) this.forget(key)
    this.start()
  }

  get(piece: Piece): Come | undefined {
    return this.come.get(keyOf(piece))
  }

  /** Fetches a failed piece again. */
  retry(piece: Piece): void {
    this.forget(keyOf(piece))
    this.start()
  }

  close(): void {
    this.want([])
    this.come.clear()
    this.bytes = 0
  }

  private start(): void {
    for (const [key, piece] of this.wanted) {
      if (this.going.size >= kAtOnce) return
      if (this.come.has(key) || this.going.has(key)) continue
      const source = this.source(piece)
      this.going.set(key, source)
      source.open().then(
        (motion) => this.take(key, source, { source, motion, bytes: motion.store.length * frameBytes(motion.store.skeleton) }),
        (fault: unknown) => this.take(key, source, { fault, bytes: 0 }),
      )
    }
  }

  private take(key: string, source: MotionSource, come: Come & { readonly bytes: number }): void {
    if (this.going.get(key) !== source) return
    this.going.delete(key)
    this.come.set(key, come)
    this.bytes += come.bytes
    for (const old of this.come.keys()) {
      if (this.bytes <= this.most) break
      if (!this.wanted.has(old)) this.forget(old)
    }
    this.start()
    this.onCome?.(key)
  }

  private forget(key: string): void {
    this.bytes -= this.come.get(key)?.bytes ?? 0
    this.come.delete(key)
  }
}
