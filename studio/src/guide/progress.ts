import { kPaths, kSteps, type About, type Facts, type Path } from './steps'

/** The user's progress on a path. */
export interface Progress {
  readonly path: Path
  readonly about: About
  /** The index of the current step; the number of steps if the path is finished. */
  readonly step: number
  /** The ids of the steps that were done. */
  readonly done: readonly string[]
  /** Whether the panel follows it; a path that was left can be resumed. */
  readonly under: boolean
  /** Whether the step was already done when it began, in which case it does not end by itself. Undefined until checked. */
  readonly met?: boolean
  /** The number of recordings when the step began. */
  readonly before?: number
}

export const begin = (path: Path, about: About): Progress => ({ path, about, step: 0, done: [], under: true })
export const stepAt = ({ path, step }: Progress) => kSteps[path].at(step)
export const isOver = ({ path, step }: Progress) => step >= kSteps[path].length

/** Goes to another step; before the first or after the last it changes nothing. */
export function goTo(progress: Progress, step: number): Progress {
  const { met: _, before: __, ...rest } = progress
  return { ...rest, step: Math.min(kSteps[progress.path].length, Math.max(0, step)) }
}
/** Marks the step as done and begins the next one. */
export function finish(progress: Progress): Progress {
  return goTo(marked(progress), progress.step + 1)
}
function marked(progress: Progress): Progress {
  const id = stepAt(progress)?.id
  return !id || progress.done.includes(id) ? progress : { ...progress, done: [...progress.done, id] }
}

/**
 * Applies new facts: a step that has just been done is over; one that was done before it began waits for the user. Returns the same object if nothing changed.
 */
export function looked(progress: Progress, facts: Omit<Facts, 'recordingsBefore'>): Progress {
  const step = stepAt(progress)
  if (!step) return progress
  const before = progress.before ?? facts.recordings
  const is = step.done?.({ ...facts, recordingsBefore: before }) ?? false
  if (is && progress.met === false) return finish(progress)
  if (progress.met !== undefined) return progress
  return { ...(is ? marked(progress) : progress), met: is, before }
}

/** Reads a stored progress; undefined if the text is something else. */
export function readProgress(text: string | null): Progress | undefined {
  try {
    const { path, about, step, done, under, met, before } = JSON.parse(text ?? '') as Progress
    const right =
      kPaths.includes(path) &&
      typeof about.database === 'string' &&
      typeof about.recording === 'string' &&
      typeof about.gloss === 'string' &&
      Number.isInteger(step) &&
      step >= 0 &&
      Array.isArray(done)
    if (!right) return undefined
    const read = goTo({ path, about, step, done: done.filter((id) => typeof id === 'string'), under: under === true }, step)
    // A step that was not done yet is recognised after a reload, too.
    return read.step === step && met === false && Number.isInteger(before) ? { ...read, met, before } : read
  } catch {
    return undefined
  }
}
