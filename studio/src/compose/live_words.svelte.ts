import { ApiError } from '../api/fault'
import type { Place } from './project'
import { wordOf } from './utterance'

/** What becomes of words. */
export interface LiveHearer {
  /** It will be signed. */
  signed(place: Place): void
  /** The server will not sign it; what comes after it goes on. */
  refused(place: Place, fault: ApiError): void
  /** There is nobody who could sign these. */
  back(places: readonly Place[]): void
}

/** Words on their way to a signer: one after the other, so that they are signed in the order in which they were typed, and none is lost. */
export class LiveWords {
  /** Those that no answer has come to. */
  waiting = $state.raw<readonly Place[]>([])
  private under = false
  private closed = false

  /** `append` waits until a signer is there; what it throws but for the server's refusals says that there is none. */
  constructor(
    private readonly append: (utterance: string) => Promise<void>,
    private readonly hearer: LiveHearer,
  ) {}

  say(places: readonly Place[]): void {
    this.waiting = [...this.waiting, ...places]
    void this.go()
  }
  /** Ends it, and gives back what was not answered. */
  close(): readonly Place[] {
    this.closed = true
    const left = this.waiting
    this.waiting = []
    return left
  }

  private async go(): Promise<void> {
    if (this.under) return
    this.under = true
    while (this.waiting.length > 0 && !this.closed) {
      const [one] = this.waiting
      try {
        await this.append(wordOf(one))
        if (!this.closed) this.next((place) => this.hearer.signed(place))
      } catch (fault) {
        if (this.closed) break
        if (fault instanceof ApiError) this.next((place) => this.hearer.refused(place, fault))
        else {
          const left = this.waiting
          this.waiting = []
          this.hearer.back(left)
        }
      }
    }
    this.under = false
  }
  private next(tell: (place: Place) => void): void {
    const [one, ...rest] = this.waiting
    this.waiting = rest
    tell(one)
  }
}
