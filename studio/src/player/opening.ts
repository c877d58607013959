import type { MotionSource } from '../motion/source'
import type { Strand } from '../viewer/showing'

/** Motions opened together, in one character's joints, and closed together. */
export class Opening {
  private readonly sources: MotionSource[] = []

  constructor(
    readonly character: string | undefined,
    private readonly onFault: (fault: Error) => void,
    private readonly onProgress: (source: MotionSource) => void,
  ) {}

  async strand(role: Strand['role'], source: MotionSource): Promise<Strand> {
    this.sources.push(source)
    source.onFault = this.onFault
    source.onProgress = () => this.onProgress(source)
    return { role, source, motion: await source.open() }
  }

  close(): void {
    for (const source of this.sources) source.close()
  }
}

/** Callbacks for the outcome: `shown` receives the opened motions, `note` a fault of an additional part, `fail` why there is nothing. */
export interface Openings<Opened> {
  readonly open: (opening: Opening) => Promise<Opened>
  readonly shown: (opened: Opened) => void
  readonly progress: (source: MotionSource) => void
  readonly note: (fault: unknown) => void
  readonly fail: (fault: unknown) => void
}

/** Motions in one character's joints, and possibly the same being opened in another's: the current ones stay until those are ready. */
export class Worn<Opened> {
  closed = false
  private current?: Opening
  private next?: Opening

  constructor(
    character: Promise<string | undefined>,
    private readonly on: Openings<Opened>,
  ) {
    character.then((name) => this.wear(name)).catch((fault: unknown) => this.fail(fault))
  }

  wear(character: string | undefined): void {
    const newest = this.next ?? this.current
    if (this.closed || (newest && newest.character === character)) return
    this.next?.close()
    const next = (this.next = new Opening(
      character,
      (fault) => this.note(fault),
      (source) => {
        if (!this.closed) this.on.progress(source)
      },
    ))
    this.on
      .open(next)
      .then((opened) => {
        if (this.next !== next) return
        this.current?.close()
        this.current = next
        this.next = undefined
        this.on.shown(opened)
      })
      .catch((fault: unknown) => {
        next.close()
        if (this.next !== next) return
        this.next = undefined
        if (this.current) this.note(fault)
        else this.fail(fault)
      })
  }

  close(): void {
    this.closed = true
    this.current?.close()
    this.next?.close()
    this.next = undefined
  }

  note(fault: unknown): void {
    if (!this.closed) this.on.note(fault)
  }
  fail(fault: unknown): void {
    if (!this.closed) this.on.fail(fault)
  }
}
