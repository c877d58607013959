import { StudioFault } from './fault'
import type { ImportPlan, Job, Recording, Synthesis } from './schema'

/// Types of the API's clients that are derived from those of its answers (schema.ts), and the checks that establish them.

export type FilePart = 'motion' | 'annotation' | 'face'
export type HandName = 'both' | 'right' | 'left'
const kImportParts = ['motion', 'face', 'annotation', 'clock', 'signer', 'rig'] as const
export type ImportPart = (typeof kImportParts)[number]
const kPartChanges = ['added', 'replaced', 'removed'] as const
/** What an import does with a part of a recording. */
export type PartChange = (typeof kPartChanges)[number]

/** Returns what an import would do with each part of a recording that it would change; throws if a part or a change is unknown. */
export function changesOf({ changes }: Pick<ImportPlan, 'changes'>): readonly [ImportPart, PartChange][] {
  return Object.entries(changes).map(([name, done]) => {
    const part = kImportParts.find((one) => one === name),
      change = kPartChanges.find((one) => one === done)
    if (!part || !change) throw new StudioFault('badAnswer', `${name}: ${done}`)
    return [part, change]
  })
}

/** A recording that has motion. */
export type MovingRecording = Recording & Required<Pick<Recording, 'frames' | 'frames_per_second' | 'clock_origin_ms'>>

export function hasMotion(recording: Recording): recording is MovingRecording {
  return recording.frames !== undefined && recording.frames_per_second !== undefined && recording.clock_origin_ms !== undefined
}
/** Returns the recording; throws if it has no motion. */
export function withMotion(recording: Recording): MovingRecording {
  if (!hasMotion(recording)) throw new StudioFault('noMotion', recording.recording)
  return recording
}

/** The answer of `sign` with `explain`: it contains the candidates of each place. */
export type ExplainedSynthesis = Synthesis & Required<Pick<Synthesis, 'places'>>

/** Returns the answer; throws if it lacks the candidates. */
export function explained(answer: Synthesis): ExplainedSynthesis {
  const { places } = answer
  if (!places) throw new StudioFault('badAnswer', 'places')
  return { ...answer, places }
}

/** A job whose result has this type. */
export type JobState<Result> = Omit<Job, 'result'> & { readonly result?: Result }
