import type { Api } from '../api/client'
import { StudioFault } from '../api/fault'
import type { AnnotationDocument } from '../annotation/document'
import type { Declarations } from '../motion/declarations'
import { StreamSource } from '../motion/stream_source'
import { Opening } from '../player/opening'
import { SignedPlaces } from '../player/signed_places.svelte'
import type { Showing, Strand } from '../viewer/showing'
import { Transport } from '../viewer/transport'

const kProgressMs = 200
const kNothing: AnnotationDocument = { tiers: [] }

/** A signer at rest who immediately signs what is appended. */
export class Live implements Showing {
  readonly transport = new Transport()
  readonly live = true
  readonly document = kNothing
  readonly original = kNothing
  readonly complete = false
  readonly inSteps = false
  strands = $state.raw<readonly Strand[]>([])
  main = $state.raw<Strand | undefined>()
  busy = $state(true)
  trouble = $state.raw<unknown>()
  arrivals = $state(0)
  leftOut = $state(0)
  declarations = $state.raw<readonly Declarations[]>([])
  private current?: Opening
  private next?: Opening
  private source?: StreamSource
  readonly signed = new SignedPlaces()
  /** Callers waiting until it is known whether there is a stream. */
  private readonly waiting: (() => void)[] = []
  private closed = false
  private lastProgress = 0

  /** `resting` is the recording whose signer rests, `how` the parameters of the stream's `open`. */
  constructor(
    private readonly api: Api,
    private readonly database: string,
    private readonly resting: string,
    private readonly how: object,
  ) {
    this.transport.live = true
  }

  timeOf(): (seconds: number) => number {
    return (seconds) => seconds
  }
  want(): void {}

  /** Opens the stream in a character's joints, replacing the one shown. */
  wear(character: string | undefined): void {
    const isThere = this.next ? this.next.character === character : this.source !== undefined && this.current?.character === character
    if (this.closed || isThere) return
    this.next?.close()
    const next: Opening = (this.next = new Opening(
      character,
      (fault) => {
        // A broken stream is over: it is reopened on the next request.
        if (this.current === next) this.source = undefined
        this.note(fault)
      },
      () => this.progress(),
    ))
    this.busy = true
    const source = new StreamSource(this.api, this.database, '', character, this.resting, this.how)
    source.onNotice = (fault) => this.note(fault)
    source.onPlace = (frame, gloss) => this.signed.push(frame, gloss)
    next
      .strand('made', source)
      .then((strand) => {
        if (this.next !== next) return
        this.current?.close()
        this.current = next
        this.next = undefined
        this.source = source
        this.trouble = undefined
        this.signed.clear()
        this.transport.time = 0
        this.transport.rate = strand.motion.store.rate
        this.main = strand
        this.strands = [strand]
        this.declarations = [strand.motion.declarations]
        this.transport.play()
        this.progress()
        this.settle()
      })
      .catch((fault: unknown) => {
        next.close()
        if (this.next !== next) return
        this.next = undefined
        this.fail(fault)
      })
  }
  /** There is no stream until the next request. */
  fail(fault: unknown): void {
    this.note(fault)
    this.settle()
  }

  /**
   * Signs this after the rest of the queue, as soon as the stream is open. Resolves once it is accepted; rejects with the server's message (ApiError) if it is
   * refused, and with a StudioFault if there is no stream.
   */
  async append(utterance: string): Promise<void> {
    while (this.busy && !this.closed) await new Promise<void>((resolve) => this.waiting.push(resolve))
    if (!this.source) throw new StudioFault('streamClosed')
    await this.source.append(utterance)
  }

  glossAt(seconds: number): string | undefined {
    return this.signed.glossAt(seconds * (this.main?.motion.store.rate ?? 1))
  }

  close(): void {
    this.closed = true
    this.next?.close()
    this.current?.close()
    this.next = this.source = undefined
    this.settle()
  }

  private settle(): void {
    this.busy = false
    for (const go of this.waiting.splice(0)) go()
  }

  private progress(): void {
    if (this.closed || !this.main || !this.source) return
    this.transport.duration = this.main.motion.store.seconds
    this.transport.growing = true
    this.leftOut = this.source.leftOut
    const now = performance.now()
    if (now - this.lastProgress < kProgressMs) return
    this.lastProgress = now
    ++this.arrivals
  }

  private note(fault: unknown): void {
    if (!this.closed) this.trouble = fault
  }
}
