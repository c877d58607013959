/** Files that are being made, as many at once as somebody asks for. */
export class Downloads {
  private readonly under = new Map<AbortController, string>()

  constructor(
    private readonly save: (file: Blob, name: string) => void,
    /** Told what was done or went wrong last, if anything, and what is still being made. */
    private readonly told: (names: readonly string[], done?: { readonly name: string; readonly fault?: unknown }) => void,
  ) {}

  async get(name: string, make: (signal: AbortSignal) => Promise<Blob>): Promise<void> {
    const mine = new AbortController()
    this.under.set(mine, name)
    this.told(this.names)
    let fault: unknown
    try {
      const file = await make(mine.signal)
      if (!mine.signal.aborted) this.save(file, name)
    } catch (wrong) {
      fault = wrong
    }
    this.under.delete(mine)
    if (!mine.signal.aborted) this.told(this.names, { name, fault })
  }
  /** Gives all up. */
  stop(): void {
    for (const one of this.under.keys()) one.abort()
  }
  private get names(): readonly string[] {
    return [...this.under.values()]
  }
}
