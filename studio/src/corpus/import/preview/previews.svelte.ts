import type { FrameStore } from '../../../motion/frame_store'
import type { OpenedMotion } from '../../../motion/source'
import { Figure } from './figure'
import { measured, type Measures } from './measures'

/** Options for reading a file: parameters of an import. */
export type Reading = Readonly<Record<string, unknown>>
/** A motion that can be drawn. */
export interface Drawn {
  readonly store: FrameStore
  readonly figure: Figure
  readonly measures: Measures
  /** Frames a second of the file. */
  readonly rate: number
}
/** A loaded preview, or the fault that prevented it. */
export type Come = { readonly drawn: Drawn; readonly fault?: undefined } | { readonly fault: unknown; readonly drawn?: undefined }

export const keyOf = (reading: Reading): string => JSON.stringify(Object.entries(reading).sort(([a], [b]) => (a < b ? -1 : 1)))

/**
 * Previews of one file by reading options, fetched one after the other: those no longer wanted are cancelled, loaded ones are cached. A fault stays as long as
 * its preview is wanted.
 */
export class Previews {
  private come = $state.raw<ReadonlyMap<string, Come>>(new Map())
  private wanted: readonly Reading[] = []
  private going?: { readonly key: string; readonly abort: AbortController }

  constructor(private readonly ask: (reading: Reading, signal: AbortSignal) => Promise<OpenedMotion>) {}

  get(reading: Reading): Come | undefined {
    return this.come.get(keyOf(reading))
  }
  /** Sets the previews that are wanted, in the order in which they are loaded. */
  want(readings: readonly Reading[]): void {
    this.wanted = readings
    const keys = new Set(readings.map(keyOf))
    if (this.going && !keys.has(this.going.key)) this.stop()
    const faults = [...this.come].filter(([key, { fault }]) => fault !== undefined && !keys.has(key))
    if (faults.length > 0) this.forget(faults.map(([key]) => key))
    this.next()
  }
  /** Requests a failed preview again. */
  retry(reading: Reading): void {
    this.forget([keyOf(reading)])
    this.next()
  }
  close(): void {
    this.wanted = []
    this.stop()
  }

  private stop(): void {
    this.going?.abort.abort()
    this.going = undefined
  }
  private forget(keys: readonly string[]): void {
    this.come = new Map([...this.come].filter(([key]) => !keys.includes(key)))
  }
  private next(): void {
    if (this.going) return
    const reading = this.wanted.find((one) => !this.come.has(keyOf(one)))
    if (!reading) return
    const going = (this.going = { key: keyOf(reading), abort: new AbortController() })
    void this.ask(reading, going.abort.signal)
      .then(drawnOf)
      .catch((fault: unknown): Come => ({ fault }))
      .then((come) => {
        if (this.going !== going) return
        this.going = undefined
        this.come = new Map(this.come).set(going.key, come)
        this.next()
      })
  }
}

function drawnOf({ store, rig, swapped, fileRate }: OpenedMotion): Come {
  const figure = new Figure(store.skeleton, rig, swapped)
  return { drawn: { store, figure, measures: measured(figure, store), rate: fileRate ?? store.rate } }
}
