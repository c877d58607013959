/** What became of something that was begun: another was begun after it, or what it was begun from is no more what is there. */
export type Outcome<T> =
  | { readonly kind: 'done'; readonly value: T }
  | { readonly kind: 'failed'; readonly fault: unknown }
  | { readonly kind: 'overtaken' }
  | { readonly kind: 'changed' }

/** Work of which only the newest counts, and that overwrites nothing that was done meanwhile. */
export class Newest {
  private asked?: AbortController

  /** `state` is what the work is to replace, compared by identity when it is done. */
  async run<T>(work: (signal: AbortSignal) => Promise<T>, state: () => unknown): Promise<Outcome<T>> {
    this.stop()
    const { signal } = (this.asked = new AbortController()),
      before = state()
    try {
      const value = await work(signal)
      return signal.aborted ? { kind: 'overtaken' } : state() === before ? { kind: 'done', value } : { kind: 'changed' }
    } catch (fault) {
      return signal.aborted ? { kind: 'overtaken' } : { kind: 'failed', fault }
    }
  }
  stop(): void {
    this.asked?.abort()
  }
}
