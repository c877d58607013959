import type { Declarations, MotionSource } from '../motion/source'
import type { Showing, Strand } from '../viewer/showing'
import { Transport } from '../viewer/transport'
import { Opening } from './opening'

const kTellMs = 200

/** A source to be shown, and as what. The first is the one that the transport's time is of. */
export interface ReelSource {
  readonly role: Strand['role']
  readonly source: MotionSource
  /** From the first's time to this one's; the same where not given. Asked for when all are open. */
  readonly timeOf?: (first: Strand, own: Strand) => (seconds: number) => number
}

/** Motions that are shown together for as long as somebody looks at them, without annotation of their own. */
export class Reel implements Showing {
  readonly transport = new Transport()
  status = $state<'opening' | 'open' | 'failed'>('opening')
  /** Why there is nothing to show. */
  fault = $state.raw<unknown>()
  /** What went wrong beside what is shown; the newest. */
  trouble = $state.raw<unknown>()
  strands = $state.raw<readonly Strand[]>([])
  arrivals = $state(0)
  /** One for each motion that is shown. */
  declarations = $state.raw<readonly Declarations[]>([])
  private current?: Opening
  private next?: Opening
  private closed = false
  private told = 0
  private times = new Map<Strand, (seconds: number) => number>()

  /** `sources` makes them in a character's joints (none: the recordings' own). Several may be told one at a time: close the reel before. */
  constructor(private readonly sources: (character: string | undefined) => readonly ReelSource[], character: Promise<string | undefined>,
              private readonly onOpen?: () => void) {
    character.then((name) => this.wear(name)).catch((fault: unknown) => this.fail(fault))
  }

  timeOf(strand: Strand): (seconds: number) => number {
    return this.times.get(strand) ?? ((seconds) => seconds)
  }

  /** The same motions in another character's joints; what is shown stays until they are there. */
  wear(character: string | undefined): void {
    const newest = this.next ?? this.current
    if (this.closed || (newest && newest.character === character)) return
    this.next?.close()
    const next = (this.next = new Opening(character, (fault) => this.note(fault), (source) => this.progress(source)))
    const all = this.sources(character)
    Promise.all(all.map(({ role, source }) => next.strand(role, source))).then((strands) => {
      if (this.next !== next) return
      this.current?.close()
      this.current = next
      this.next = undefined
      this.times = new Map(strands.map((strand, i) => [strand, all[i].timeOf?.(strands[0], strand) ?? ((seconds: number) => seconds)]))
      this.show(strands)
    }).catch((fault: unknown) => {
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

  private show(strands: readonly Strand[]): void {
    const first = this.strands.length === 0
    this.strands = strands
    this.transport.rate = strands[0].motion.store.rate
    this.transport.duration = Math.max(...strands.map(({ motion }) => motion.store.seconds))
    this.declarations = strands.map(({ motion }) => motion.declarations)
    this.status = 'open'
    ++this.arrivals
    if (first) this.onOpen?.()
  }

  private progress(source: MotionSource): void {
    const now = performance.now()
    if (this.closed || (!source.complete && now - this.told < kTellMs)) return
    this.told = now
    ++this.arrivals
  }

  private note(fault: unknown): void {
    if (!this.closed) this.trouble = fault
  }

  private fail(fault: unknown): void {
    if (this.closed) return
    this.fault = fault
    this.status = 'failed'
  }
}
