import type { AnnotationDocument } from '../../annotation/document'
import { readEaf } from '../../annotation/eaf'
import type { Recording } from '../../api/schema'
import type { Api } from '../../api/client'
import { proposals, storedRecording } from '../../api/corpus_calls'
import { isChecked, readChecked, rewritten, standOf, type Stand } from './checked_tiers'
import { dropDraft, isKeyOf, isOf, keepDraft, keptDraft, revisionOf, type Draft, type Revision } from './draft'
import { begun, pushed, redone, undone, type History } from './history'
import { acceptedAll, decided, filled, find, following, inOrder, kEmpty, reviewOf, within, type Frames, type Hand, type Review, type State } from './review'

const kNoTiers: AnnotationDocument = { tiers: [] }
const kNone: Stand = { right: '', left: '' }

/** The review of a recording's phases, proposed or continued from a draft, together with its annotation. */
export class PhasesSession {
  status = $state<'opening' | 'open' | 'failed'>('opening')
  fault = $state.raw<unknown>()
  /** Why no proposals could be made. */
  unproposed = $state.raw<unknown>()
  proposing = $state(false)
  /** The origin of the review. */
  from = $state<'draft' | 'stored' | 'proposed'>('proposed')
  /** A local draft that belongs to an earlier motion of the recording. */
  other = $state.raw<Draft | undefined>()
  history = $state.raw<History<Review>>(begun(kEmpty))
  current = $state<number | undefined>()
  /** The annotation without the tiers under review. */
  document = $state.raw<AnnotationDocument>(kNoTiers)
  info = $state.raw<Recording | undefined>()
  /** Whether the review is stored in this browser; false if it has no room. */
  kept = $state(true)
  /** Whether there are changes that are not stored. */
  changed = $state(false)
  frames: Frames = { originMs: 0, rate: 100, count: 0 }
  /**
   * Another window has stored a draft since this one did: its review, or undefined if the review was stored or discarded there. Until the user chooses, no
   * draft is stored here.
   */
  elsewhere = $state.raw<{ readonly draft?: Draft } | undefined>()
  /** The stored annotation, into which the phases are written. */
  annotation = $state.raw<AnnotationDocument>({ tiers: [] })
  /** Hands whose checked phases were stored by someone else since this review began: those stay. */
  conflicting = $state.raw<readonly Hand[]>([])
  /** The checked phases that were stored when the review began, and those stored now. */
  private begunOn: Stand = kNone
  private stand: Stand = kNone
  private readonly abort = new AbortController()
  private base?: Review
  private seen: Revision
  /** The annotation on the server; undefined if it has none. */
  private found?: string

  constructor(
    private readonly api: Api,
    readonly database: string,
    readonly recording: string,
  ) {
    addEventListener('storage', this.onstorage)
    void this.open()
  }

  get review(): Review {
    return this.history.now
  }

  async open(): Promise<void> {
    this.status = 'opening'
    this.fault = undefined
    try {
      await this.read()
      this.frames = framesOf(this.info!)
      this.seen = revisionOf(this.database, this.recording)
      this.elsewhere = undefined
      const draft = keptDraft(this.database, this.recording)
      const stored = this.readStored()
      if (draft && isOf(draft, this.frames)) this.begin(draft.review, 'draft', draft.stand)
      else {
        this.other = draft
        if (stored) this.begin(stored, 'stored')
        else await this.propose()
      }
      this.status = 'open'
    } catch (fault) {
      this.fault = fault
      this.status = 'failed'
    }
  }

  /** Adds proposals where there are no phases. A failure of the segmenter is reported; phases can be added by hand. */
  async propose(): Promise<void> {
    this.proposing = true
    this.unproposed = undefined
    try {
      const proposed = reviewOf(await proposals(this.api, this.database, this.recording, this.abort.signal), this.frames)
      if (inOrder(this.review).length > 0) this.apply(filled(this.review, proposed))
      else this.begin(proposed, 'proposed')
    } catch (fault) {
      if (!this.abort.signal.aborted) this.unproposed = fault
    }
    this.proposing = false
  }

  close(): void {
    this.abort.abort()
    removeEventListener('storage', this.onstorage)
  }

  /** Sets another state of the review, which can be undone. */
  apply(review: Review): void {
    if (review === this.review) return
    this.history = pushed(this.history, review)
    this.keep()
  }
  /** Sets the state while a border is dragged: no undo step until it is released. */
  preview(review: Review): void {
    this.history = { ...this.history, now: review }
  }
  /** Ends a preview: the change since `before` becomes one step. */
  settle(before: Review): void {
    const now = this.review
    this.history = pushed({ ...this.history, now: before }, now)
    if (now !== before) this.keep()
  }
  undo(): void {
    this.history = undone(this.history)
    this.keep()
  }
  redo(): void {
    this.history = redone(this.history)
    this.keep()
  }
  /** Sets the state of the current phase, and moves on to the next open one. */
  decide(state: State): void {
    if (this.current === undefined || !find(this.review, this.current)) return
    this.apply(decided(this.review, this.current, state))
    if (state !== 'open') this.current = following(this.review, this.current, 1, true)?.id ?? this.current
  }
  acceptAll(): void {
    this.apply(acceptedAll(this.review))
  }

  /** Discards what was not stored. */
  async discard(): Promise<void> {
    this.drop()
    this.other = undefined
    this.history = begun(kEmpty)
    this.current = undefined
    const stored = this.readStored()
    if (stored) this.begin(stored, 'stored')
    else await this.propose()
  }
  /** Adopts a review of another motion, as far as it fits. */
  takeOther(): void {
    if (!this.other) return
    const review = within(this.other.review, this.frames),
      { stand } = this.other
    this.other = undefined
    this.begin(review, 'draft', stand)
    this.keep()
  }
  dropOther(): void {
    this.other = undefined
    if (!this.changed) this.drop()
  }

  /** Adopts the other window's review; undo restores this window's. */
  takeElsewhere(): void {
    const { draft } = this.elsewhere ?? {}
    if (!draft || !isOf(draft, this.frames)) return void this.open()
    this.elsewhere = undefined
    this.seen = revisionOf(this.database, this.recording)
    this.history = pushed(this.history, draft.review)
    this.isOn(draft.stand)
    this.changed = true
    if (!find(draft.review, this.current)) this.current = undefined
  }
  /** Keeps this window's review in place of the other's. */
  keepMine(): void {
    this.elsewhere = undefined
    this.seen = revisionOf(this.database, this.recording)
    this.keep()
  }

  /**
   * Rereads the recording: returns `annotation` if another annotation was stored since, into which this review is written from now on; `motion` if the motion
   * is no longer the one reviewed.
   */
  async renew(): Promise<'same' | 'annotation' | 'motion'> {
    const { found, info: before } = this
    await this.read()
    this.isOn(this.begunOn)
    if (!isOf({ frames: framesOf(this.info!), review: this.review }, this.frames)) return 'motion'
    return this.found === found && this.info?.annotation_fingerprint === before?.annotation_fingerprint ? 'same' : 'annotation'
  }

  /** Called after the annotation was stored: decided phases are in the file. */
  async stored(): Promise<void> {
    await this.read()
    this.isOn()
    this.base = this.review
    this.changed = false
    // Open phases are in no file, so the draft stays.
    if (inOrder(this.review).every(({ state }) => state !== 'open')) this.drop()
  }

  private readStored(): Review | undefined {
    return readChecked(this.annotation)
  }
  private drop(): void {
    dropDraft(this.database, this.recording, this.seen)
    this.seen = this.elsewhere ? this.seen : undefined
  }
  /** Another window has stored or dropped a draft. */
  private readonly onstorage = ({ key }: StorageEvent): void => {
    if (this.status === 'open' && isKeyOf(key, this.database, this.recording)) this.lookElsewhere()
  }
  private lookElsewhere(): void {
    const same = revisionOf(this.database, this.recording) === this.seen
    this.elsewhere = same ? undefined : { draft: keptDraft(this.database, this.recording) }
  }

  private begin(review: Review, from: 'draft' | 'stored' | 'proposed', stand?: Stand): void {
    this.history = begun(review)
    this.isOn(stand)
    this.from = from
    this.base = from === 'draft' ? undefined : review
    this.changed = from === 'draft'
    this.current = undefined
  }
  /** Records on which stored phases the review is based: by default those stored now. */
  private isOn(stand = this.stand): void {
    this.begunOn = stand
    const hands = rewritten(stand, this.stand)
    if (hands.join() !== this.conflicting.join()) this.conflicting = hands
  }
  private keep(): void {
    this.changed = this.review !== this.base
    if (this.elsewhere) return
    const done = keepDraft(this.database, this.recording, { frames: this.frames, review: this.review, stand: this.begunOn }, this.seen)
    if (done === 'changed') return this.lookElsewhere()
    this.kept = done !== 'full'
    if (done !== 'full') this.seen = done.revision
  }
  /** Loads the recording and its stored annotation; that of a recording without annotation is empty. */
  private async read(): Promise<void> {
    const info = await storedRecording(this.api, this.database, this.recording)
    const found = info.annotation_file ? await this.api.annotation(this.database, this.recording) : undefined
    this.info = info
    if (found === this.found) return
    this.annotation = found === undefined ? { tiers: [] } : readEaf(found)
    this.found = found
    this.stand = standOf(this.annotation)
    this.document = { tiers: this.annotation.tiers.filter(({ name }) => isChecked(name) === undefined) }
  }
}

const framesOf = ({ clock_origin_ms: originMs = 0, frames_per_second: rate = 0, frames: count = 0 }: Recording): Frames => ({ originMs, rate, count })
