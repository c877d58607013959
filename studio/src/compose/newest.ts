/** The outcome of a task: done, failed, superseded by a newer task, or obsolete because its base state has changed. */
export type Outcome<T> =
  | { readonly kind: 'done'; readonly value: T }
  | { readonly kind: 'failed'; readonly fault: unknown }
  | { readonly kind: 'overtaken' }
  | { readonly kind: 'changed' }

/** Runs tasks of which only the newest counts, and never overwrites changes made meanwhile. */
export class Newest {
  private asked?: AbortController

  /** `state` returns what the task will replace, compared by identity when it is done. */
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
