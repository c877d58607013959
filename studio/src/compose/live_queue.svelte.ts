import { ApiError } from '../api/fault'
import type { Place } from './project'
import { wordOf } from './utterance'

/** Callbacks for the fate of queued words. */
export interface LiveHearer {
  /** It will be signed. */
  signed(place: Place): void
  /** The server refuses it; the following words continue. */
  refused(place: Place, fault: ApiError): void
  /** These are returned because no signer is available. */
  back(places: readonly Place[]): void
}

/** Typed words on their way to a signer: sent one after the other, so that they are signed in the order in which they were typed and none is lost. */
export class LiveQueue {
  /** The words not answered yet. */
  waiting = $state.raw<readonly Place[]>([])
  private under = false
  private closed = false

  /** `append` waits until a signer is available; any error other than a refusal by the server means that there is no signer. */
  constructor(
    private readonly append: (utterance: string) => Promise<void>,
    private readonly hearer: LiveHearer,
  ) {}

  say(places: readonly Place[]): void {
    this.waiting = [...this.waiting, ...places]
    void this.go()
  }
  /** Ends the queue and returns the words that were not answered. */
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
  private next(report: (place: Place) => void): void {
    const [one, ...rest] = this.waiting
    this.waiting = rest
    report(one)
  }
}
