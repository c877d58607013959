import type { Api } from '../../api/client'
import { PieceSource } from '../../motion/piece_source'
import type { Showing, Strand } from '../../viewer/showing'
import { Transport } from '../../viewer/transport'
import type { Item, Settings, Trial } from './study'

/** The motion shown, and the version of the program that generated it. */
interface Made {
  readonly strands: readonly Strand[]
  readonly version: string
}
interface Opened {
  readonly key: string
  readonly made: Promise<Made>
  readonly close: () => void
}

/** The motions of a trial: the captured and the generated one, as A and B or one alone, distinguished by nothing but their motion. */
export class BlindShow implements Showing {
  readonly transport = new Transport()
  readonly oneCamera = true
  strands = $state.raw<readonly Strand[]>([])
  arrivals = $state(0)
  /** The version of the program that generated the motion. */
  version = ''
  private current?: Opened
  private next?: Opened

  /** `dressed` resolves when the character can be drawn, so that both bodies appear at once. */
  constructor(
    private readonly api: Api,
    private readonly database: string,
    private readonly settings: Pick<Settings, 'mode' | 'character'>,
    private readonly dressed: () => Promise<unknown>,
  ) {
    this.transport.repeat = true
  }

  /** Shows a trial once all of it is loaded. Rejects if it cannot be loaded, and can then be called again. */
  async show(item: Item, trial: Trial): Promise<void> {
    const opened = this.open(item, trial)
    if (this.current !== opened) this.current?.close()
    this.current = opened
    if (this.next === opened) this.next = undefined
    this.transport.pause()
    this.strands = []
    try {
      const { strands, version } = await opened.made
      if (this.current !== opened) return
      this.version = version
      const { transport } = this
      this.strands = strands
      transport.rate = strands[0].motion.store.rate
      transport.duration = Math.max(...strands.map(({ motion }) => motion.store.seconds))
      transport.loop = null
      transport.time = 0
      ++this.arrivals
    } catch (fault) {
      if (this.current !== opened) return
      this.current = undefined
      throw fault
    }
  }

  /** Loads the next trial while the current one is viewed. */
  prepare(item: Item, trial: Trial): void {
    const opened = this.open(item, trial)
    if (opened === this.next || opened === this.current) return
    this.next?.close()
    this.next = opened
    opened.made.catch(() => {
      if (this.next === opened) this.next = undefined
    }) // it is requested again when its turn comes
  }

  timeOf(): (seconds: number) => number {
    return (seconds) => seconds
  }

  close(): void {
    this.current?.close()
    this.next?.close()
    this.current = this.next = undefined
  }

  private open(item: Item, { item: number, side }: Trial): Opened {
    const key = `${number} ${side}`
    for (const known of [this.next, this.current]) if (known?.key === key) return known
    const options = { from: item.begin, to: item.end, character: this.settings.character ?? undefined }
    const regenerated = item.method ? { ...options, regenerate: `${item.from}..${item.to}`, transition: item.method } : options
    // In the order of the sides, so that not even the order of the calls reveals the answer.
    const both = side === 'left' ? [options, regenerated] : [regenerated, options]
    const sources = (this.settings.mode === 'single' ? both.slice(0, 1) : both).map(
      (one, i, all) => new PieceSource(this.api, this.database, item.recording, one, all.length > 1 ? 'AB'[i] : ''),
    )
    const strands = Promise.all(sources.map(async (source): Promise<Strand> => ({ role: 'blind', source, motion: await source.open() })))
    // The server may run another program version than when the study was set up.
    const made = Promise.all([strands, this.api.version(), this.dressed()]).then(([strands, version]) => ({ strands, version: `signweave ${version}` }))
    return { key, made, close: () => sources.forEach((source) => source.close()) }
  }
}
