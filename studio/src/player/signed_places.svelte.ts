const kMost = 2000
const kRecent = 20

/** Which gloss a live stream signs, and from which frame on. */
export class SignedPlaces {
  /** Where the last glosses begin, as `VANNES@27 MATIN@140`: it stays, when a slow page has drawn no picture of them. */
  recent = $state('')
  /** In order; none of a rest. */
  private readonly places: { readonly frame: number; readonly gloss?: string }[] = []

  push(frame: number, gloss?: string): void {
    this.places.push({ frame, gloss })
    if (this.places.length > kMost) this.places.splice(0, kMost / 2)
    this.recent = this.places
      .slice(-kRecent)
      .filter((place) => place.gloss !== undefined)
      .map((place) => `${place.gloss}@${place.frame}`)
      .join(' ')
  }

  clear(): void {
    this.places.length = 0
    this.recent = ''
  }

  glossAt(frame: number): string | undefined {
    for (let i = this.places.length - 1; i >= 0; --i) if (this.places[i].frame <= frame) return this.places[i].gloss
    return undefined
  }
}
