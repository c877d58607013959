import type { Api } from '../api/client'
import { ApiError } from '../api/fault'
import type { AnnotationDocument } from '../annotation/document'
import { readEaf } from '../annotation/eaf'
import { beside, stepsOfSigns, type Steps } from '../motion/in_step'
import { MadeSource } from '../motion/made_source'
import { RecordingSource } from '../motion/recording_source'
import type { Declarations, MotionSource, OpenedMotion } from '../motion/source'
import { StreamSource } from '../motion/stream_source'
import type { Route } from '../ui/route'
import { Transport } from '../viewer/transport'

/** What the player can show. */
export type Shown = Extract<Route, { page: 'recording' | 'sign' | 'edit' }>

/** One motion of the player; the second and later ones go along with the first. */
export interface Strand {
  readonly role: 'only' | 'original' | 'made' | 'beside'
  readonly source: MotionSource
  readonly motion: OpenedMotion
}

const kTellMs = 200
const kEmpty: AnnotationDocument = { tiers: [], media: [] }

/** Opens what a route asks for, and keeps what the player shows of it. Nothing here is touched for every picture. */
export class Session {
  readonly transport = new Transport()
  status = $state<'opening' | 'open' | 'failed'>('opening')
  /** Why there is nothing to show. */
  fault = $state.raw<unknown>()
  /** What went wrong beside what is shown; the newest. */
  trouble = $state.raw<unknown>()
  strands = $state.raw<readonly Strand[]>([])
  /** The strand that the transport's time and the timeline are of. */
  main = $state.raw<Strand | undefined>()
  document = $state.raw<AnnotationDocument>(kEmpty)
  /** Whether the annotation has come, or is known not to come. */
  annotated = $state(false)
  /** One for each motion that is shown. */
  declarations = $state.raw<readonly Declarations[]>([])
  /** Rises as pieces of the main motion come, at most five times a second. */
  arrivals = $state(0)
  complete = $state(false)
  leftOut = $state(0)
  /** Pairs the strands sign by sign; else by time. */
  bySign = $state(true)
  private readonly sources: MotionSource[] = []
  private steps = $state.raw<Steps | undefined>()
  /** Of a live stream: from which frame on which gloss is signed; none at rest. */
  private readonly places: { frame: number; gloss?: string }[] = []
  private closed = false
  private told = 0

  constructor(private readonly api: Api, readonly shown: Shown) {
    this.open().catch((fault: unknown) => this.fail(fault))
  }

  /** The time of a strand beside a time of the main one, both in seconds from frame 0. */
  timeOf(strand: Strand): (seconds: number) => number {
    if (strand === this.main) return (seconds) => seconds
    return (seconds) => (this.steps && this.bySign ? beside(this.steps, seconds) : seconds)
  }

  get inSteps(): boolean {
    return this.steps !== undefined
  }

  /** The gloss that a live stream signs at a time. */
  liveGloss(seconds: number): string | undefined {
    const frame = seconds * (this.main?.motion.store.rate ?? 1)
    for (let i = this.places.length - 1; i >= 0; --i) if (this.places[i].frame <= frame) return this.places[i].gloss
    return undefined
  }

  /** Signs this next, where a stream is live. */
  signNext(utterance: string): void {
    this.trouble = undefined
    const { source } = this.main ?? {}
    if (source instanceof StreamSource) source.sign(utterance)
  }

  close(): void {
    this.closed = true
    for (const source of this.sources) source.close()
  }

  private async open(): Promise<void> {
    const { shown } = this
    if (shown.page === 'recording') await this.openRecording(shown)
    else if (shown.page === 'edit') await this.openEdit(shown)
    else await this.openSigning(shown)
  }

  private async openRecording(shown: Extract<Shown, { page: 'recording' }>): Promise<void> {
    const { api } = this
    this.transport.time = shown.at
    void this.annotate(api.annotation(shown.database, shown.recording))
    const source = new RecordingSource(api, shown.database, shown.recording, api.recording(shown.database, shown.recording), shown.at)
    // What stands beside may be wrong without the recording being so.
    const other = shown.beside ? this.strand('beside', this.recordingSource(shown.beside, shown.at)).catch((fault: unknown) => this.note(fault)) : undefined
    const [first, second] = await Promise.all([this.strand('only', source), other])
    this.show(second ? [first, second] : [first], first)
  }

  private async openEdit(shown: Extract<Shown, { page: 'edit' }>): Promise<void> {
    const { api } = this
    const body = { recording: shown.recording, ...(shown.swap ? { swap: shown.swap } : { replace: shown.replace }) }
    const made = new MadeSource(api, shown.recording, api.madeUrl(shown.database, 'edit'), body, api.recording(shown.database, shown.recording))
    const original = api.annotation(shown.database, shown.recording).then(readEaf).catch((fault: unknown) => this.note(fault))
    const annotated = this.annotate(api.madeAnnotation(shown.database, 'edit', body), false)
    const [left, right] = await Promise.all([this.strand('original', this.recordingSource(shown.recording)), this.strand('made', made)])
    this.show([left, right], right)
    const signs = right.motion.signs ?? []
    const glosses = (await original)?.tiers.find(({ depth, annotations }) => depth === 0 && annotations.length === signs.length)
    if (glosses && !shown.swap) this.steps = stepsOfSigns(signs, glosses.annotations, left.motion.originMs)
    await annotated
    this.annotated = true
  }

  private async openSigning(shown: Extract<Shown, { page: 'sign' }>): Promise<void> {
    const live = shown.pace === 'live'
    const source = new StreamSource(this.api, shown.database, shown.utterance, shown.pace)
    source.onNotice = (fault) => this.note(fault)
    source.onPlace = (frame, gloss) => {
      this.places.push({ frame, gloss })
      if (this.places.length > 2000) this.places.splice(0, 1000)
    }
    const strand = await this.strand('made', source)
    // Asked for only where the stream says that it can be signed: the same fault need not be told twice.
    if (live) this.annotated = true
    else void this.annotate(this.api.madeAnnotation(shown.database, 'sign', { utterance: shown.utterance }))
    this.transport.live = live
    this.show([strand], strand)
    this.transport.play()
  }

  private recordingSource(recording: string, startSeconds = 0): RecordingSource {
    const { database } = this.shown
    return new RecordingSource(this.api, database, recording, this.api.recording(database, recording), startSeconds)
  }

  private async strand(role: Strand['role'], source: MotionSource): Promise<Strand> {
    this.sources.push(source)
    source.onFault = (fault) => this.note(fault)
    source.onProgress = () => this.progress(source)
    return { role, source, motion: await source.open() }
  }

  /** Motion without annotation is fine; that it could not be had is told. */
  private async annotate(eaf: Promise<string>, alone = true): Promise<void> {
    try {
      const read = readEaf(await eaf)
      if (!this.closed) this.document = read
    } catch (fault) {
      if (!(fault instanceof ApiError && fault.status === 404)) this.note(fault)
    }
    if (alone) this.annotated = true
  }

  private show(strands: readonly Strand[], main: Strand): void {
    if (this.closed) return
    this.main = main
    this.strands = strands
    this.transport.rate = main.motion.store.rate
    this.declarations = strands.map(({ motion }) => motion.declarations)
    this.progress(main.source)
    this.status = 'open'
  }

  private progress(source: MotionSource): void {
    if (this.closed) return
    const main = source === this.main?.source
    if (main) {
      const first = this.transport.duration === 0
      this.transport.duration = this.main!.motion.store.seconds
      this.transport.growing = source.grows && !source.complete
      if (first) this.transport.seek(this.transport.time)
      if (source instanceof StreamSource) this.leftOut = source.leftOut
      if (source.complete) this.complete = true
    }
    // Frames of a stream come fifty times a second; what hangs on this need not be drawn anew so often.
    const now = performance.now()
    if (!source.complete && this.told > 0 && now - this.told < kTellMs) return
    this.told = now
    ++this.arrivals
  }

  private note(fault: unknown): undefined {
    if (!this.closed) this.trouble = fault
  }

  private fail(fault: unknown): void {
    if (this.closed) return
    this.fault = fault
    this.status = 'failed'
  }
}
