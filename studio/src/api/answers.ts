import type { Remedy } from './fault'
/// What the calls of docs/http.md answer, as far as the studio reads it. Times are ms, lengths metres.

import type { Declarations } from '../motion/declarations'

export interface DatabaseRow {
  readonly name: string
  readonly recordings: number
  readonly writable: boolean
  readonly declarations: Declarations
}
export interface RecordingRow {
  readonly name: string
  readonly signer: string
  readonly frames: number
  readonly frames_per_second: number
  readonly joints: number
  readonly tracks: readonly string[]
  readonly defects: number
}
/** A part of the body: the joint's name and index, and for a tip its offset in metres. */
export interface PartRow {
  readonly joint: string
  readonly index: number
  readonly offset?: readonly [number, number, number]
}
export interface RecordingInfo {
  readonly recording: string
  readonly frames: number
  readonly frames_per_second: number
  readonly clock_origin_ms: number
}
/** A signer that motion can be put on; its GLB is at `Api.characterUrl`. */
export interface CharacterRow {
  readonly name: string
  readonly file: string
  readonly height: number
  readonly face_units: readonly string[]
}
/** A film that the annotation links. */
export interface MediaRow {
  /** Its plain name. */
  readonly file: string
  readonly mime: string
  /** The film's time at annotation time 0. */
  readonly origin_ms: number
  /** Where the server sends it; null where the server has not got it. */
  readonly url: string | null
}
export interface Spread {
  readonly count: number
  readonly mean?: number
  readonly sd?: number
  readonly quantiles?: Readonly<Record<string, number>>
}
export interface Transitions {
  readonly inferred?: boolean
  readonly whole: { readonly duration_ms: Spread }
  /** Not where transitions are inferred from the gaps between signs, for no phases are annotated. */
  readonly retraction?: { readonly duration_ms: Spread }
  readonly preparation?: { readonly duration_ms: Spread }
}
export interface Statistics {
  readonly all: Transitions
  readonly recordings: readonly (Transitions & { readonly recording: string })[]
}
/** One sign of a report: where it is in the new motion and where it was recorded. */
export interface ReportSign {
  readonly gloss: string
  /** Of the utterance, from 0. */
  readonly place: number
  readonly clip: number
  readonly begin_ms: number
  readonly end_ms: number
  readonly recording: string
  readonly recorded: { readonly begin_ms: number; readonly end_ms: number }
  readonly phases?: readonly { readonly kind: string; readonly begin_ms: number; readonly end_ms: number }[]
}
export interface FrameSpan {
  readonly begin: number
  readonly end: number
}
/** Signs of one recording as they were captured, and what of it is kept: frames of the new motion. */
export interface ReportClip {
  readonly clip: number
  /** The first place of the utterance that it is of. */
  readonly place: number
  readonly recording: string
  readonly frames: FrameSpan
  readonly kept_frames: FrameSpan
  readonly kept_from_recorded_frame: number
  readonly recorded_frames_per_frame: number
}
/** The transition between two clips. */
export interface ReportJunction {
  readonly from_clip: number
  readonly to_clip: number
  readonly from: string
  readonly to: string
  readonly method: string
  readonly frames: FrameSpan
  readonly retraction_frames: number
  readonly preparation_frames: number
  readonly blend_frames: number
}
/** What `sign` and `edit` tell of what they made. */
export interface Report {
  readonly frames: number
  readonly frames_per_second: number
  readonly signs: readonly ReportSign[]
  readonly clips: readonly ReportClip[]
  readonly junctions: readonly ReportJunction[]
}
/** A token that may fill a place, and what it costs there; `join` is that to the one chosen before. */
export interface CandidateRow {
  readonly recording: string
  readonly token: number
  readonly frames: FrameSpan
  readonly cost: number
  readonly target_cost: number
  readonly target: Readonly<Record<string, number>>
  readonly kept?: boolean
  readonly join_cost?: number
  readonly join?: Readonly<Record<string, number>>
}
/** A report with `explain`: what there was to choose from, place by place. */
export interface ExplainedReport extends Report {
  readonly places: readonly { readonly candidates: readonly CandidateRow[]; readonly chosen: number }[]
}
/** A sign that a query found. */
export interface SignAnswer {
  readonly name: string
  readonly recording: string
  readonly tier: string
  readonly begin_ms: number
  readonly end_ms: number
}
/** A way of making transitions. */
export interface TransitionRow {
  readonly name: string
  readonly description: string
}

/** What the annotations of a tier say, in the order of the alphabet, and how many say it. */
export interface TierLabels {
  readonly labels: readonly { readonly label: string; readonly annotations: number }[]
}

/** What is in a database, for completion. */
export interface Vocabulary {
  /** In the order of the alphabet, with the number of tokens that can be found. */
  readonly glosses: readonly { readonly gloss: string; readonly tokens: number }[]
  readonly tiers: readonly string[]
  readonly recordings: readonly string[]
  readonly signers: readonly string[]
  /** The words of the query language, by what they are. */
  readonly language: Readonly<Record<'fields' | 'links' | 'phases' | 'hands' | 'functions' | 'points', readonly string[]>>
}
export interface JobBegun {
  readonly job: string
}
export interface JobState<Result> {
  readonly state: 'waiting' | 'running' | 'done' | 'failed' | 'cancelled'
  /** 0 to 1. */
  readonly fraction: number
  readonly result?: Result
  readonly error?: { readonly message: string; readonly code: string }
}
/** A place of an utterance's text, as docs/http.md describes it; spans count characters (code points) from 0. */
export type UtterancePlaceRow = { readonly pause?: 'comma' | 'stop'; readonly begin: number; readonly end: number } & (
  { readonly gloss: string; readonly token?: number } | { readonly recording: string; readonly from_ms: number; readonly to_ms: number }
)
export interface UtteranceFaultRow {
  readonly code: string
  readonly message: string
  readonly line: number
  readonly column: number
  readonly begin: number
  readonly end: number
  readonly remedies?: readonly Remedy[]
}
export interface UtteranceAnswer {
  readonly places: readonly UtterancePlaceRow[]
  /** After the last place. */ readonly pause?: 'comma' | 'stop'
  readonly faults: readonly UtteranceFaultRow[]
}
/** What stopped nothing: a guess or a hint. */
export interface NoticeRow {
  readonly where: string
  readonly text: string
}
