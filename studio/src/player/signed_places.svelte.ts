const kMost = 2000
const kRecent = 20

/** The glosses that a live stream signs, with their first frames. */
export class SignedPlaces {
  /** The begins of the last glosses, such as `VANNES@27 MATIN@140`; also contains those of which a slow page drew no frame. */
  recent = $state('')
  /** In order; without a gloss for a rest. */
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
