import type { MediaRow } from '../api/schema'
import type { Api } from '../api/client'
import { ApiError } from '../api/fault'
import type { AnnotationDocument } from '../annotation/document'
import { readEaf } from '../annotation/eaf'
import { documentOf } from '../annotation/made_document'
import { correspondingTime, stepsOfSigns, type Steps } from '../motion/in_step'
import { MadeSource } from '../motion/made_source'
import { RecordingSource } from '../motion/recording_source'
import type { Declarations } from '../motion/declarations'
import type { MotionSource } from '../motion/source'
import { StreamSource } from '../motion/stream_source'
import { preferences } from '../ui/preferences.svelte'
import type { Route } from '../ui/route'
import type { Showing, Strand } from '../viewer/showing'
import { Transport } from '../viewer/transport'
import { Worn, type Opening } from './opening'
import { SignedPlaces } from './signed_places.svelte'

/** The routes that the player can show. */
export type Shown = Extract<Route, { page: 'recording' | 'sign' | 'edit' }>
export const isShown = (route: Route): route is Shown => route.page === 'recording' || route.page === 'sign' || route.page === 'edit'

const kProgressMs = 200
const kEmpty: AnnotationDocument = { tiers: [] }

/** Opens what a route specifies, and holds what the player shows of it. Nothing here runs for every frame. */
export class Session implements Showing {
  readonly transport = new Transport()
  status = $state<'opening' | 'open' | 'failed'>('opening')
  /** Why there is nothing to show. */
  fault = $state.raw<unknown>()
  /** The newest fault of an additional part. */
  trouble = $state.raw<unknown>()
  strands = $state.raw<readonly Strand[]>([])
  /** The strand that the transport's time and the timeline belong to. */
  main = $state.raw<Strand | undefined>()
  /** Of the recording, or of the result, as the timeline draws it. */
  readonly document: AnnotationDocument = $derived.by(() => {
    const { report } = this.main?.motion ?? {}
    return report ? documentOf(report, preferences.text) : this.recorded
  })
  private recorded = $state.raw<AnnotationDocument>(kEmpty)
  /** Videos linked by the recording's annotation. */
  media = $state.raw<readonly MediaRow[]>([])
  /** Whether the annotation is loaded, or known to be unavailable. */
  annotated = $state(false)
  /** One for each motion shown. */
  declarations = $state.raw<readonly Declarations[]>([])
  /** Increases as pieces of the main motion arrive, at most five times a second. */
  arrivals = $state(0)
  complete = $state(false)
  leftOut = $state(0)
  /** Synchronizes the strands sign by sign; otherwise by time. */
  bySign = $state(true)
  private readonly worn: Worn<{ strands: readonly Strand[]; main: Strand }>
  private steps = $state.raw<Steps | undefined>()
  /** For an edit, the annotation of the recording that was edited. */
  original = $state.raw<AnnotationDocument>(kEmpty)
  private originalRead?: Promise<void>
  /** For a live stream. */
  readonly signed = new SignedPlaces()
  private lastProgress = 0

  /** `character` names the character whose joints the poses are for; undefined for the recordings' own. */
  constructor(
    private readonly api: Api,
    readonly shown: Shown,
    character: Promise<string | undefined>,
  ) {
    if (shown.page === 'recording') this.transport.time = shown.at || Math.max(0, (shown.span?.[0] ?? 0) / 1000)
    this.worn = new Worn(character, {
      open: (opening) => this.strandsOf(opening),
      shown: ({ strands, main }) => this.show(strands, main),
      progress: (source) => this.progress(source),
      note: (fault) => (this.trouble = fault),
      fail: (fault) => {
        this.fault = fault
        this.status = 'failed'
      },
    })
    this.annotateAll()
  }

  /** Returns the mapping from the main strand's time to a strand's time, both in seconds from frame 0. */
  timeOf(strand: Strand): (seconds: number) => number {
    if (strand.source === this.main?.source) return (seconds) => seconds
    return (seconds) => (this.steps && this.bySign ? correspondingTime(this.steps, seconds) : seconds)
  }

  get inSteps(): boolean {
    return this.steps !== undefined
  }

  /** Returns the gloss that a live stream signs at a time. */
  liveGloss(seconds: number): string | undefined {
    return this.signed.glossAt(seconds * (this.main?.motion.store.rate ?? 1))
  }

  /** Signs this next, if a stream is live. */
  signNext(utterance: string): void {
    this.trouble = undefined
    const { source } = this.main ?? {}
    if (source instanceof StreamSource) source.sign(utterance)
  }

  /** Sets the current time, so that each motion fetches what it needs next. */
  want(seconds: number): void {
    for (const strand of this.strands) strand.source.want?.(this.timeOf(strand)(seconds))
  }

  /** Reopens the motions in another character's joints; the current ones stay until these are ready. */
  wear(character: string | undefined): void {
    this.worn.wear(character)
  }

  close(): void {
    this.worn.close()
  }

  private async strandsOf(opening: Opening): Promise<{ strands: readonly Strand[]; main: Strand }> {
    const { shown, api } = this
    const { database } = shown
    const { character } = opening
    const recorded = (name: string) => new RecordingSource(api, database, name, character, this.transport.time)
    if (shown.page === 'recording') {
      // The second recording may fail without affecting the first.
      const other = shown.compare ? opening.strand('compared', recorded(shown.compare)).catch((fault: unknown) => this.note(fault)) : undefined
      const [main, second] = await Promise.all([opening.strand('only', recorded(shown.recording)), other])
      return { strands: second ? [main, second] : [main], main }
    }
    if (shown.page === 'edit') {
      const made = new MadeSource(api, database, shown.recording, 'edit', bodyOf(shown), character)
      const [left, main] = await Promise.all([opening.strand('original', recorded(shown.recording)), opening.strand('made', made)])
      await this.pair(left, main)
      return { strands: [left, main], main }
    }
    const main = await opening.strand(
      'made',
      shown.pace === 'live'
        ? this.stream(database, shown.utterance, character)
        : new MadeSource(api, database, shown.utterance, 'sign', bodyOf(shown), character),
    )
    return { strands: [main], main }
  }

  private stream(database: string, utterance: string, character?: string): StreamSource {
    const source = new StreamSource(this.api, database, utterance, character)
    source.onNotice = (fault) => this.note(fault)
    source.onPlace = (frame, gloss) => this.signed.push(frame, gloss)
    this.signed.clear()
    this.transport.time = 0
    return source
  }

  /** Pairs the signs of the original with the signs made from them. */
  private async pair(left: Strand, made: Strand): Promise<void> {
    if (this.shown.page !== 'edit' || this.shown.swap || this.steps) return
    const signs = made.motion.signs ?? []
    await this.originalRead
    const glosses = this.original.tiers.find(({ depth, annotations }) => depth === 0 && annotations.length === signs.length)
    if (glosses) this.steps = stepsOfSigns(signs, glosses.annotations, left.motion.originMs)
  }

  private annotateAll(): void {
    const { api, shown } = this
    const { database } = shown
    if (shown.page === 'recording') {
      void this.annotate(api.annotation(database, shown.recording))
      api.media(database, shown.recording).then(
        (media) => (this.media = media),
        (fault: unknown) => this.note(fault),
      )
    } else if (shown.page === 'edit') {
      this.originalRead = api
        .annotation(database, shown.recording)
        .then((eaf) => void (this.original = readEaf(eaf)))
        .catch((fault: unknown) => this.note(fault))
    } else if (shown.pace === 'live') this.annotated = true
  }

  /** A missing annotation is fine; a failure to load one is reported. */
  private async annotate(eaf: Promise<string>): Promise<void> {
    try {
      const read = readEaf(await eaf)
      if (!this.worn.closed) this.recorded = read
    } catch (fault) {
      if (!(fault instanceof ApiError && fault.status === 404)) this.note(fault)
    }
    this.annotated = true
  }

  private show(strands: readonly Strand[], main: Strand): void {
    const first = this.main === undefined
    this.main = main
    this.strands = strands
    this.transport.rate = main.motion.store.rate
    this.declarations = strands.map(({ motion }) => motion.declarations)
    this.complete = main.source.complete
    this.transport.live = main.source instanceof StreamSource
    this.progress(main.source)
    this.status = 'open'
    // The annotation of a result comes with its frames.
    if (main.motion.report) this.annotated = true
    if (first && this.shown.page === 'recording' && this.shown.span) this.select(this.shown.span, this.shown.at)
    if (first && this.shown.page === 'sign') this.transport.play()
  }

  /** Selects a span of annotation time, and seeks to its begin unless another time was specified. */
  private select([from, to]: readonly [number, number], at: number): void {
    const { originMs } = this.main!.motion
    this.transport.setLoop((from - originMs) / 1000, (to - originMs) / 1000)
    if (!at) this.transport.seek(this.transport.loop?.begin ?? 0)
    this.want(this.transport.time)
  }

  private progress(source: MotionSource): void {
    const main = source === this.main?.source
    if (main) {
      const first = this.transport.duration === 0
      this.transport.duration = this.main!.motion.store.seconds
      this.transport.growing = source.grows && !source.complete
      if (first) this.transport.seek(this.transport.time)
      if (source instanceof StreamSource) this.leftOut = source.leftOut
      if (source.complete) this.complete = true
    }
    // Frames of a stream arrive fifty times a second; what depends on them need not be redrawn so often.
    const now = performance.now()
    if (!source.complete && this.lastProgress > 0 && now - this.lastProgress < kProgressMs) return
    this.lastProgress = now
    ++this.arrivals
  }

  private note(fault: unknown): undefined {
    this.worn.note(fault)
  }
}

/** Returns the parameters of the call that generates the motion. */
function bodyOf(shown: Extract<Shown, { page: 'sign' | 'edit' }>): object {
  if (shown.page === 'sign') return { utterance: shown.utterance }
  return { recording: shown.recording, ...(shown.swap ? { swap: shown.swap } : { replace: shown.replace }) }
}
