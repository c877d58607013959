import type { Declarations } from '../motion/declarations'
import type { MotionSource } from '../motion/source'
import type { Showing, Strand } from '../viewer/showing'
import { Transport } from '../viewer/transport'
import { Worn } from './opening'

const kProgressMs = 200

/** A source to be shown, and its role. The transport's time is that of the first one. */
export interface ReelSource {
  readonly role: Strand['role']
  readonly source: MotionSource
  /** Maps the first motion's time to this one's; identity by default. Called when all are open. */
  readonly timeOf?: (first: Strand, own: Strand) => (seconds: number) => number
}

interface Opened {
  readonly strands: readonly Strand[]
  readonly times: ReadonlyMap<Strand, (seconds: number) => number>
}

/** Motions shown together temporarily, without their own annotation. */
export class Reel implements Showing {
  readonly transport = new Transport()
  status = $state<'opening' | 'open' | 'failed'>('opening')
  /** Why there is nothing to show. */
  fault = $state.raw<unknown>()
  /** The newest fault of an additional part. */
  trouble = $state.raw<unknown>()
  strands = $state.raw<readonly Strand[]>([])
  arrivals = $state(0)
  /** One for each motion shown. */
  declarations = $state.raw<readonly Declarations[]>([])
  private readonly worn: Worn<Opened>
  private lastProgress = 0
  private times: Opened['times'] = new Map()

  /** `sources` creates them in a character's joints (undefined: the recordings' own). A reel shows one set of sources; close it before the next. */
  constructor(
    private readonly sources: (character: string | undefined) => readonly ReelSource[],
    character: Promise<string | undefined>,
    private readonly onOpen?: () => void,
  ) {
    this.worn = new Worn<Opened>(character, {
      open: async (opening) => {
        const all = this.sources(opening.character)
        const strands = await Promise.all(all.map(({ role, source }) => opening.strand(role, source)))
        return { strands, times: new Map(strands.map((strand, i) => [strand, all[i].timeOf?.(strands[0], strand) ?? ((seconds: number) => seconds)])) }
      },
      shown: (opened) => this.show(opened),
      progress: (source) => this.progress(source),
      note: (fault) => (this.trouble = fault),
      fail: (fault) => {
        this.fault = fault
        this.status = 'failed'
      },
    })
  }

  timeOf(strand: Strand): (seconds: number) => number {
    return this.times.get(strand) ?? ((seconds) => seconds)
  }

  /** Reopens the motions in another character's joints; the current ones stay until these are ready. */
  wear(character: string | undefined): void {
    this.worn.wear(character)
  }

  close(): void {
    this.worn.close()
  }

  private show({ strands, times }: Opened): void {
    const first = this.strands.length === 0
    this.times = times
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
    if (!source.complete && now - this.lastProgress < kProgressMs) return
    this.lastProgress = now
    ++this.arrivals
  }
}
