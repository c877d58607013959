/** Counts the corrections of each recording: an answer to an earlier request says nothing about later corrections. */
export class Revisions {
  private readonly counts = new Map<string, number>()

  bump(keys: Iterable<string>): void {
    for (const key of keys) this.counts.set(key, (this.counts.get(key) ?? 0) + 1)
  }
  /** Returns a function that reports whether a recording is unchanged since this call. */
  mark(): (key: string) => boolean {
    const then = new Map(this.counts)
    return (key) => this.counts.get(key) === then.get(key)
  }
}
