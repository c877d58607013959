import type { AnnotationDocument } from '../../annotation/document'
import { readEaf } from '../../annotation/eaf'
import type { StoredRecording } from '../../api/corpus_answers'
import type { Api } from '../../api/client'
import { annotationBytes, proposals, storedRecording } from '../../api/corpus_calls'
import { emptyEaf, isChecked, readChecked } from './checked_tiers'
import { dropDraft, isOf, keepDraft, keptDraft, type Draft } from './draft'
import { begun, pushed, redone, undone, type History } from './history'
import { acceptedAll, decided, filled, find, following, inOrder, kEmpty, reviewOf, within, type Frames, type Review, type State } from './review'
import { decoded } from './xml_text'

const kNoTiers: AnnotationDocument = { tiers: [] }

/** The phases of a recording under review: proposed, or taken up where somebody left them; and its annotation beside them. */
export class PhasesSession {
  status = $state<'opening' | 'open' | 'failed'>('opening')
  fault = $state.raw<unknown>()
  /** Why nothing could be proposed. */
  unproposed = $state.raw<unknown>()
  proposing = $state(false)
  /** Where the review came from. */
  from = $state<'draft' | 'stored' | 'proposed'>('proposed')
  /** A review that was kept here, of another motion than the recording has now. */
  other = $state.raw<Draft | undefined>()
  history = $state.raw<History<Review>>(begun(kEmpty))
  current = $state<number | undefined>()
  /** What is annotated, without the tiers that are under review. */
  document = $state.raw<AnnotationDocument>(kNoTiers)
  info = $state.raw<StoredRecording | undefined>()
  /** Whether what is under review is kept in this browser; no where it has no room. */
  kept = $state(true)
  /** Whether something was changed that is not stored. */
  changed = $state(false)
  frames: Frames = { originMs: 0, rate: 100, count: 0 }
  /** The annotation as it is stored; what is written is written into it. */
  eaf = ''
  private readonly abort = new AbortController()
  private base?: Review

  constructor(private readonly api: Api, readonly database: string, readonly recording: string) {
    void this.open()
  }

  get review(): Review {
    return this.history.now
  }

  async open(): Promise<void> {
    this.status = 'opening'
    this.fault = undefined
    try {
      const info = await this.read()
      this.frames = { originMs: info.clock_origin_ms ?? 0, rate: info.frames_per_second ?? 0, count: info.frames ?? 0 }
      const draft = keptDraft(this.database, this.recording)
      const stored = readChecked(readEaf(this.eaf))
      if (draft && isOf(draft, this.frames)) this.begin(draft.review, 'draft')
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

  /** Puts proposals where nothing is. What the segmenter cannot do is told; phases may be added by hand. */
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
  }

  /** Another state of the review, which can be undone. */
  apply(review: Review): void {
    if (review === this.review) return
    this.history = pushed(this.history, review)
    this.keep()
  }
  /** What it is while a border is dragged: not a step of its own until it is let go. */
  preview(review: Review): void {
    this.history = { ...this.history, now: review }
  }
  /** Ends a preview: from `before` on it is one step. */
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
  /** Decides about the current phase, and goes on to the next that is open. */
  decide(state: State): void {
    if (this.current === undefined || !find(this.review, this.current)) return
    this.apply(decided(this.review, this.current, state))
    if (state !== 'open') this.current = following(this.review, this.current, 1, true)?.id ?? this.current
  }
  acceptAll(): void {
    this.apply(acceptedAll(this.review))
  }

  /** Gives up what was not stored. */
  async discard(): Promise<void> {
    dropDraft(this.database, this.recording)
    this.other = undefined
    this.history = begun(kEmpty)
    this.current = undefined
    const stored = readChecked(readEaf(this.eaf))
    if (stored) this.begin(stored, 'stored')
    else await this.propose()
  }
  /** Takes over a review that was of another motion, as far as it fits. */
  takeOther(): void {
    if (!this.other) return
    const review = within(this.other.review, this.frames)
    this.other = undefined
    this.begin(review, 'draft')
    this.keep()
  }
  dropOther(): void {
    this.other = undefined
    if (!this.changed) dropDraft(this.database, this.recording)
  }

  /** The annotation as it is now was stored: what is decided is kept there. */
  async stored(): Promise<void> {
    await this.read()
    this.base = this.review
    this.changed = false
    // What is still open is in no file, so it stays here.
    if (inOrder(this.review).every(({ state }) => state !== 'open')) dropDraft(this.database, this.recording)
  }

  private begin(review: Review, from: 'draft' | 'stored' | 'proposed'): void {
    this.history = begun(review)
    this.from = from
    this.base = from === 'draft' ? undefined : review
    this.changed = from === 'draft'
    this.current = undefined
  }
  private keep(): void {
    this.changed = this.review !== this.base
    this.kept = keepDraft(this.database, this.recording, { frames: this.frames, review: this.review })
  }
  /** Asks for the recording and its annotation as they are stored; one that has none gets an empty document. */
  private async read(): Promise<StoredRecording> {
    const info = (this.info = await storedRecording(this.api, this.database, this.recording))
    const bytes = info.annotation_file ? await annotationBytes(this.api, this.database, this.recording) : undefined
    this.eaf = bytes ? decoded(bytes) : emptyEaf(info.motion_file, new Date().toISOString())
    this.document = { tiers: readEaf(this.eaf).tiers.filter(({ name }) => isChecked(name) === undefined) }
    return info
  }
}
