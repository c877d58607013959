import { keyOf, type Piece, type Pieces } from '../motion/pieces'
import type { Showing, Strand } from '../viewer/showing'
import { Transport } from '../viewer/transport'
import type { Answer } from './answers'

/** Ms fetched before and after an answer, and shown on request. */
const kAround = 200

/** Shows one answer after the other as a loop on the same stage. */
export class AnswerLoop implements Showing {
  readonly transport = new Transport()
  strands = $state.raw<readonly Strand[]>([])
  arrivals = $state(0)
  fault = $state.raw<unknown>()
  /** Whether the requested motion has not arrived yet. */
  waiting = $state(false)
  /** Whether some context is shown, too. */
  around = $state(false)
  private answer?: Answer
  private piece?: Piece

  constructor(private readonly pieces: Pieces) {
    pieces.onCome = (key) => {
      if (this.piece && key === keyOf(this.piece)) this.take()
    }
  }

  timeOf(): (seconds: number) => number {
    return (seconds) => seconds
  }

  /** Shows an answer as soon as it is loaded; `next` are those probably shown next. Both in a character's joints. */
  show(answer: Answer | undefined, next: readonly Answer[], character: string | undefined): void {
    this.answer = answer
    this.piece = answer && pieceOf(answer, character)
    this.pieces.want([...(this.piece ? [this.piece] : []), ...next.map((one) => pieceOf(one, character))])
    if (this.piece) this.take()
    else this.strands = []
  }

  setAround(around: boolean): void {
    this.around = around
    this.repeat()
  }

  retry(): void {
    if (!this.piece) return
    this.fault = undefined
    this.waiting = true
    this.pieces.retry(this.piece)
  }

  private take(): void {
    const come = this.pieces.get(this.piece!)
    this.waiting = !come
    this.fault = come?.fault
    if (!come?.motion || come.motion === this.strands[0]?.motion) return
    const { motion, source } = come
    this.transport.rate = motion.store.rate
    this.transport.duration = motion.store.seconds
    this.transport.held = false
    this.repeat(motion.originMs)
    // The first answer plays automatically, unless the system is set to reduced motion; later the user's setting is kept.
    if (this.strands.length === 0 && !matchMedia('(prefers-reduced-motion: reduce)').matches) this.transport.play()
    this.strands = [{ role: 'only', source, motion }]
    ++this.arrivals
  }

  /** Restarts the loop: the answer, or the answer with its context. */
  private repeat(originMs = this.strands[0]?.motion.originMs): void {
    if (!this.answer || originMs === undefined) return
    const { transport } = this,
      { begin, end } = this.answer
    const around = this.around ? kAround : 0
    transport.setLoop((begin - around - originMs) / 1000, (end + around - originMs) / 1000)
    transport.seek(transport.loop?.begin ?? 0)
  }
}

function pieceOf({ recording, begin, end }: Answer, character: string | undefined): Piece {
  return { recording, from: begin - kAround, to: end + kAround, character }
}
