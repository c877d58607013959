import type { Synthesis } from '../api/schema'
import type { Api } from '../api/client'
import type { AnnotationDocument } from '../annotation/document'
import { documentOf } from '../annotation/made_document'
import { correspondingTime, stepsOfSigns, type Steps } from '../motion/in_step'
import { MadeSource } from '../motion/made_source'
import { RecordingSource } from '../motion/recording_source'
import type { Declarations } from '../motion/declarations'
import type { MotionSource } from '../motion/source'
import { Opening } from '../player/opening'
import { en, type Text } from '../text/en'
import type { Showing, Strand } from '../viewer/showing'
import { Transport, type Loop } from '../viewer/transport'
import { bodyOf } from './body'
import { layoutOf, type PlaceLayout } from './layout'
import { firstChange, type Project } from './project'
import { mainSigns } from './start'
import { utteranceOf } from './utterance'

const kProgressMs = 200
const kNothing: AnnotationDocument = { tiers: [] }
/** Seconds of context shown around a junction. */
const kAround = 0.4

/** What is shown next to the result: the recording that it was made from, or the same signs joined differently. */
export type Comparison =
  { readonly kind: 'original'; readonly recording: string } | { readonly kind: 'method'; readonly title: string; readonly other: Project }

/** A request for a result. */
export interface SigningRequest {
  readonly project: Project
  readonly title: string
  readonly comparison?: Comparison
}
/** The displayed result: its request, and the server's report. */
export interface Made {
  readonly request: SigningRequest
  readonly report: Synthesis
  readonly layout?: PlaceLayout
}

/** A recording shown for comparison; `before` is the one shown until this one is loaded. */
interface Recorded {
  readonly key: string
  readonly opening: Opening
  readonly strand: Promise<Strand>
  before?: Recorded
}

/** Regenerates a project's signing after each change. The previous result stays on screen until the new one is there, and also if it fails. */
export class Making implements Showing {
  readonly transport = new Transport()
  readonly live = false
  strands = $state.raw<readonly Strand[]>([])
  /** The strand that the transport's time and the timeline belong to. */
  main = $state.raw<Strand | undefined>()
  made = $state.raw<Made | undefined>()
  /** A newer result is being generated. */
  busy = $state(false)
  /** Why the newest result failed, or part of it could not be loaded. */
  trouble = $state.raw<unknown>()
  arrivals = $state(0)
  declarations = $state.raw<readonly Declarations[]>([])
  /** Synchronizes the strands sign by sign; otherwise by time. */
  bySign = $state(true)
  /** The signs of the original shown. */
  original = $state.raw<AnnotationDocument>(kNothing)
  /** The id of the place before which the looping junction is. */
  around: number | undefined
  /** The loop around that junction; a loop that the user set since is a different one. */
  private aroundLoop: Loop | null = null
  private current?: Opening
  private next?: Opening
  private steps = $state.raw<Steps | undefined>()
  /** A recording shown for comparison: it stays while everything else is regenerated. */
  private recorded?: Recorded
  /** The result, as the timeline draws it. */
  readonly document: AnnotationDocument = $derived.by(() => (this.made ? documentOf(this.made.report, this.labels()) : kNothing))
  private closed = false
  private lastProgress = 0

  /** `labels` returns the labels of the result's parts. */
  constructor(
    private readonly api: Api,
    private readonly database: string,
    private readonly labels: () => Text = () => en,
  ) {}

  get complete(): boolean {
    return this.main?.source.complete ?? true
  }
  get inSteps(): boolean {
    return this.steps !== undefined
  }

  timeOf(strand: Strand): (seconds: number) => number {
    if (strand.source === this.main?.source) return (seconds) => seconds
    return (seconds) => (this.steps && this.bySign ? correspondingTime(this.steps, seconds) : seconds)
  }
  want(seconds: number): void {
    for (const strand of this.strands) strand.source.want?.(this.timeOf(strand)(seconds))
  }

  /** Generates what is requested, in a character's joints; a request in progress is cancelled. */
  make(request: SigningRequest, character: string | undefined): void {
    if (this.closed) return
    this.next?.close()
    this.next = undefined
    if (request.project.places.length === 0) return this.clear()
    const next = (this.next = new Opening(
      character,
      (fault) => this.note(fault),
      (source) => this.progress(source),
    ))
    this.busy = true
    this.open(request, next)
      .then((strands) => {
        if (this.next !== next) return
        this.current?.close()
        this.current = next
        this.next = undefined
        this.busy = false
        this.trouble = undefined
        this.show(request, strands)
      })
      .catch((fault: unknown) => {
        next.close()
        if (this.next !== next) return
        this.next = undefined
        this.busy = false
        this.note(fault)
      })
  }

  /** Loops the junction before a place; returns false if it is no junction of the result. */
  loopAround(id: number): boolean {
    const seam = this.seamOf(id)
    if (!seam) return false
    this.around = id
    this.transport.setLoop(seam.begin - kAround, seam.end + kAround)
    this.aroundLoop = this.transport.loop
    this.transport.seek(this.transport.loop?.begin ?? seam.begin)
    return true
  }
  seamOf(id: number) {
    const { made } = this
    return made?.layout?.seams[made.request.project.places.findIndex((place) => place.id === id)]
  }

  close(): void {
    this.closed = true
    this.next?.close()
    this.current?.close()
    this.forgetOriginal()
    this.next = undefined
  }

  private async open({ project, title, comparison: other }: SigningRequest, opening: Opening): Promise<readonly Strand[]> {
    const { api, database } = this
    const { character } = opening
    const sign = (one: Project, called: string) => new MadeSource(api, database, called, 'sign', bodyOf(one), character)
    const main = opening.strand(other?.kind === 'method' ? 'compared' : 'made', sign(project, title))
    if (!other) return [await main]
    if (other.kind === 'method') return Promise.all([main, opening.strand('compared', sign(other.other, other.title))])
    const [left, made] = await Promise.all([this.originalStrand(other.recording, character), main])
    return [left, made]
  }

  private originalStrand(recording: string, character: string | undefined): Promise<Strand> {
    const key = JSON.stringify([recording, character])
    if (this.recorded?.key === key) return this.recorded.strand
    const opening = new Opening(
      character,
      (fault) => this.note(fault),
      (source) => this.progress(source),
    )
    const strand = Promise.all([opening.strand('original', new RecordingSource(this.api, this.database, recording, character)), this.readOriginal(recording)])
    const mine: Recorded = { key, opening, strand: strand.then(([one]) => one), before: this.recorded }
    this.recorded = mine
    strand.then(
      () => {
        mine.before?.opening.close()
        mine.before = undefined
      },
      () => {
        opening.close()
        if (this.recorded === mine) this.recorded = mine.before // to be retried on the next request
      },
    )
    return mine.strand
  }
  private async readOriginal(recording: string): Promise<void> {
    const signs = mainSigns(await this.api.signs(this.database, recording))
    this.original = {
      tiers: [{ name: 'Gloss', depth: 0, annotations: signs.map(({ name, begin_ms, end_ms }) => ({ begin: begin_ms, end: end_ms, label: name })) }],
    }
  }

  private show(request: SigningRequest, strands: readonly Strand[]): void {
    const { transport } = this,
      before = this.made
    const main = strands.find(({ role }) => role === 'made') ?? strands[0]
    const { report } = main.motion
    if (!report) return this.note(new Error('no report'))
    const other = request.comparison?.kind === 'method' ? strands[1].motion.report : undefined
    const layout = layoutOf(request.project.places, report)
    this.steps = other
      ? stepsOfSigns(
          report.signs,
          other.signs.map(({ begin_ms, end_ms }) => ({ begin: begin_ms, end: end_ms })),
          0,
        )
      : this.stepsOfOriginal(request, report, strands[0])
    this.made = { request, report, layout }
    this.main = main
    this.strands = strands
    if (request.comparison?.kind !== 'original') this.forgetOriginal()
    this.declarations = strands.map(({ motion }) => motion.declarations)
    const atEnd = !transport.loop && transport.time >= transport.duration - 1.5 / transport.rate
    transport.rate = main.motion.store.rate
    transport.duration = main.motion.store.seconds
    ++this.arrivals
    this.goOn(before, request, layout, atEnd)
  }

  /** Chooses where playback of a new result continues: around the same junction, otherwise, unless playback was paused, a little before the change. */
  private goOn(before: Made | undefined, { project }: SigningRequest, layout: PlaceLayout | undefined, atEnd: boolean): void {
    const { transport } = this
    const change = before ? firstChange(before.request.project, project) : 0
    const { time } = transport
    const wasAround = this.around !== undefined && transport.loop !== null && transport.loop === this.aroundLoop
    if (!wasAround) this.around = undefined
    else if (!this.loopAround(this.around!)) {
      // The junction no longer exists, so there is nothing to loop.
      transport.loop = null
      this.around = undefined
    } else if (!transport.playing) transport.seek(time)
    if (transport.loop) {
      if (!wasAround) transport.setLoop(transport.loop.begin, transport.loop.end)
    } else if ((transport.playing || atEnd) && change < project.places.length) {
      const from = change === 0 ? 0 : (layout?.seams[change]?.begin ?? layout?.places[change]?.begin ?? transport.time)
      transport.seek(from - (change === 0 ? 0 : kAround))
      transport.play()
      return
    }
    transport.seek(transport.time)
  }

  /** Pairs the k-th sign of the original with the k-th of the result, if their numbers are equal. */
  private stepsOfOriginal({ comparison: other }: SigningRequest, { signs }: Synthesis, { motion }: Strand): Steps | undefined {
    const annotations = this.original.tiers[0]?.annotations ?? []
    return other?.kind === 'original' && annotations.length === signs.length ? stepsOfSigns(signs, annotations, motion.originMs) : undefined
  }

  private forgetOriginal(): void {
    for (let one = this.recorded; one; one = one.before) one.opening.close()
    this.recorded = undefined
  }
  private clear(): void {
    this.current?.close()
    this.current = undefined
    this.forgetOriginal()
    this.around = undefined
    this.busy = false
    this.trouble = this.main = this.made = this.steps = undefined
    this.strands = []
    this.declarations = []
    this.transport.pause()
    this.transport.loop = null
    this.transport.time = this.transport.duration = 0
    ++this.arrivals
  }

  private progress(source: MotionSource): void {
    const now = performance.now()
    if (this.closed || (!source.complete && now - this.lastProgress < kProgressMs)) return
    this.lastProgress = now
    ++this.arrivals
  }

  private note(fault: unknown): void {
    if (!this.closed) this.trouble = fault
  }
}

/** Returns the title of a project on the screen and as a file: its text, shortened. */
export function titleOf(project: Project, most = 60): string {
  const text = utteranceOf({ ...project, places: project.places.slice(0, most) })
  return text.length > most ? `${text.slice(0, most).trimEnd()}…` : text
}
