/** How often each recording was corrected: what was asked before says nothing of what was corrected meanwhile. */
export class Revisions {
  private readonly counts = new Map<string, number>()

  bump(keys: Iterable<string>): void {
    for (const key of keys) this.counts.set(key, (this.counts.get(key) ?? 0) + 1)
  }
  /** Tells later of each recording whether it is still as it is now. */
  mark(): (key: string) => boolean {
    const then = new Map(this.counts)
    return (key) => this.counts.get(key) === then.get(key)
  }
}
