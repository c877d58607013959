/** Files in preparation; any number may run at once. */
export class Downloads {
  private readonly under = new Map<AbortController, string>()

  constructor(
    private readonly save: (file: Blob, name: string) => void,
    /** Called with the names still in preparation and, if there is one, the last success or failure. */
    private readonly report: (names: readonly string[], done?: { readonly name: string; readonly fault?: unknown }) => void,
  ) {}

  async get(name: string, make: (signal: AbortSignal) => Promise<Blob>): Promise<void> {
    const mine = new AbortController()
    this.under.set(mine, name)
    this.report(this.names)
    let fault: unknown
    try {
      const file = await make(mine.signal)
      if (!mine.signal.aborted) this.save(file, name)
    } catch (wrong) {
      fault = wrong
    }
    this.under.delete(mine)
    if (!mine.signal.aborted) this.report(this.names, { name, fault })
  }
  /** Cancels all downloads. */
  stop(): void {
    for (const one of this.under.keys()) one.abort()
  }
  private get names(): readonly string[] {
    return [...this.under.values()]
  }
}
