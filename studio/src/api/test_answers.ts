import type { CandidateJoin, FileFormat, FoundSegment, ImportedReply, InspectedRecording, RecordingRow, ReportJunction, ReportSign, Synthesis } from './schema'

/// Complete answers for tests, from the values that a test is about.

export const signAnswer = (sign: Pick<ReportSign, 'begin_ms' | 'end_ms'> & Partial<ReportSign>): ReportSign => ({
  gloss: 'A',
  place: 0,
  clip: 0,
  recording: 'r',
  recorded: { begin_ms: 0, end_ms: 1000 },
  phases: [],
  ...sign,
})

const kCut = { retraction_frames: 1, preparation_frames: 2, waits: false }
/** The junction before clip `to_clip`, which is of the place of the same number. */
export const junctionAnswer = (junction: Pick<ReportJunction, 'to_clip' | 'frames'> & Partial<ReportJunction>): ReportJunction => ({
  number: junction.to_clip,
  place: junction.to_clip,
  from_clip: junction.to_clip - 1,
  from: 'A',
  to: 'B',
  method: 'gap',
  retraction_frames: 1,
  preparation_frames: 2,
  blend_frames: 3,
  parts: { body: kCut, left: kCut, right: kCut },
  ...junction,
})

export const synthesisAnswer = (report: Omit<Synthesis, 'stretches' | 'timings' | 'declarations' | 'notices'>): Synthesis => ({
  stretches: report.clips,
  timings: { semantic_query_ms: 0, selection_ms: 0, retrieval_ms: 0, concatenation_ms: 0, total_ms: 0 },
  declarations: {},
  notices: [],
  ...report,
})

export const joinAnswer = (join: Partial<CandidateJoin>): CandidateJoin => ({
  place: 0,
  velocity: 0,
  handshape: 0,
  direction: 0,
  arms: 0,
  trunk: 0,
  speed: 0,
  unknown: 0,
  ...join,
})

export const segmentAnswer = (segment: Omit<FoundSegment, 'parts'>): FoundSegment => ({ parts: [], ...segment })

export const formatAnswer = (extension: string, reads: boolean): FileFormat => ({
  extension,
  ending: extension,
  name: extension,
  reads,
  writes: false,
  holds: '',
  lost: '',
})

/** A recording to be added. */
export const inspectedAnswer = (recording: Pick<InspectedRecording, 'name'> & Partial<InspectedRecording>): InspectedRecording => ({
  files: { motion: `${recording.name}.bvh`, annotation: null, face: null },
  known: false,
  plan: { recording: recording.name, outcome: 'added', changes: {} },
  ...recording,
})

export const addedAnswer = (name: string): ImportedReply => ({ name, outcome: 'added', declarations: {} })

/** A recording without motion, unless `more` has it. */
export const recordingRow = (name: string, signer: string, more: Partial<RecordingRow> = {}): RecordingRow => ({
  name,
  signer,
  motion_file: '',
  annotation_file: '',
  defects: 0,
  notices: [],
  ...more,
})
