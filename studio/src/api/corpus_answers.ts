import type { Remedy } from './fault'
import type { JobState, RecordingRow } from './answers'

/// What the calls that fill and change a database answer, as far as the studio reads it. Times are ms, lengths metres.

/** A format of files: its extension with the dot, and what the server does with it. */
export interface FormatRow {
  readonly extension: string
  readonly name: string
  readonly reads: boolean
  readonly writes: boolean
  readonly holds: string
}
/** What the server guessed or found odd. */
export interface Notice {
  readonly where: string
  readonly text: string
  readonly remedies?: readonly Remedy[]
}

/** A recording of the list, with how it is stored. One without motion has no frames. */
export interface StoredRow extends Omit<RecordingRow, 'frames' | 'frames_per_second' | 'joints' | 'tracks'> {
  readonly frames?: number
  readonly frames_per_second?: number
  readonly joints?: number
  readonly tracks?: readonly string[]
  readonly motion_file: string
  readonly annotation_file: string
  readonly face_file?: string
  readonly access_mode?: string
  readonly compact_mm?: number
}
export interface DatabaseInfo {
  /** Of recordings that are to come. */
  readonly access_mode: string
  readonly compact_mm: number
  readonly documents: string
  readonly bytes_on_disk: number
  readonly recordings: readonly StoredRow[]
}

export interface Defect {
  readonly kind: string
  readonly joint: string | null
  readonly value: number
  readonly text: string
  /** Not where it is of the whole motion. */
  readonly first_frame?: number
  readonly end_frame?: number
}
export interface RigPart {
  readonly joint: string
  readonly index: number
  readonly evidence: 'name' | 'shape' | 'file'
  readonly confidence: number
}
export interface RigReport {
  readonly convention: string
  readonly sides_swapped: boolean
  readonly parts: Readonly<Record<string, RigPart>>
  readonly notices: readonly string[]
}
/** All that is known of a stored recording. What only motion has is not there without. */
export interface StoredRecording {
  readonly recording: string
  readonly signer: string
  readonly motion_file: string
  readonly face_file: string
  readonly annotation_file: string
  /** Changes with the annotation; "none" where there is none. */
  readonly annotation_fingerprint: string
  readonly frames?: number
  readonly frames_per_second?: number
  readonly seconds?: number
  readonly clock_origin_ms?: number
  readonly phases: number
  readonly phases_measured: number
  readonly not_measured: string
  readonly notices: readonly Notice[]
  readonly rig?: RigReport
  readonly defects?: readonly Defect[]
}

export type FilePart = 'motion' | 'annotation' | 'face'
export type HandName = 'both' | 'right' | 'left'
export interface TierReport {
  readonly tier: string
  readonly parent: string | null
  readonly annotations: number
  readonly labels: number
  readonly role: 'signs' | 'phases' | ''
  readonly hand: HandName
}
export type ImportPart = FilePart | 'clock' | 'signer' | 'rig'
/** What an import would change in the database. */
export interface ImportPlan {
  /** The name in the database. */
  readonly recording: string
  /** That of the import, or `refused`. */
  readonly outcome: string
  readonly changes: Readonly<Partial<Record<ImportPart, 'added' | 'replaced' | 'removed'>>>
  /** Why the import would be refused. */
  readonly error?: string
  readonly remedies?: readonly Remedy[]
}
/** What an import would store of one recording; with `error` only the first three and `plan` are there. */
export interface Inspected {
  readonly name: string
  readonly files: Readonly<Record<FilePart, string | null>>
  /** The database has one of this name, or of the same files. */
  readonly known: boolean
  readonly plan?: ImportPlan | undefined
  readonly error?: string
  /** What would fix the error. */
  readonly remedies?: readonly Remedy[]
  readonly signer?: string
  readonly frames?: number
  readonly frames_per_second?: number
  readonly seconds?: number
  readonly tracks?: readonly string[]
  readonly signs?: number
  readonly phases?: number
  readonly defects?: readonly Defect[]
  readonly not_measured?: string
  readonly notices?: readonly Notice[]
  /** How a BVH file looked, as it was read or guessed: metres in a unit. */
  readonly layout?: { readonly up: string; readonly unit: number; readonly root_unit: number; readonly root_order: string; readonly mirrored: boolean } | null
  readonly rig?: RigReport | null
  readonly tiers?: readonly TierReport[]
  readonly declarations?: Readonly<Record<string, string>>
  /** The skeleton's joints by name. */
  readonly joints?: readonly string[]
  /** Annotation time of frame 0. */
  readonly clock_origin_ms?: number
}
export interface Inspection {
  readonly recordings: readonly Inspected[]
  readonly notices: readonly Notice[]
  readonly faults: readonly string[]
}

/** What became of one recording. */
export interface Imported {
  readonly name: string
  readonly outcome: string
  readonly error?: string
  /** What would fix the error. */
  readonly remedies?: readonly Remedy[]
  readonly frames?: number
  readonly signs?: number
  readonly defects?: number
  readonly not_measured?: string
  readonly notices?: readonly Notice[]
}
export interface ImportResult {
  readonly recordings: readonly Imported[]
  readonly notices: readonly Notice[]
  readonly faults: readonly string[]
}
export interface RelayoutResult {
  readonly recordings: number
  readonly changed: readonly string[]
  readonly faults: readonly string[]
}
export type JobListener<Result> = (state: JobState<Result>) => void

/** A phase that the segmenter proposes, in ms of the motion: frame 0 is at 0. */
export interface ProposedPhase {
  readonly phase: string
  readonly begin_ms: number
  readonly end_ms: number
  readonly confidence: number
}
export interface Proposals {
  readonly proposed: string
  readonly hands: Readonly<Record<'left' | 'right', readonly ProposedPhase[]>>
}
