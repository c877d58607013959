import { kPaths, kSteps, type About, type Facts, type Path } from './steps'

/** How far somebody is on a path. */
export interface Progress {
  readonly path: Path
  readonly about: About
  /** Its number; as many as there are steps where all is over. */
  readonly step: number
  /** What was done, by `id`. */
  readonly done: readonly string[]
  /** Whether the panel goes along; a path that was left can be taken up again. */
  readonly under: boolean
  /** Whether the step was done when it began, so that it is not left by itself. Unknown until it was looked. */
  readonly met?: boolean
  /** How many recordings there were when the step began. */
  readonly before?: number
}

export const begin = (path: Path, about: About): Progress => ({ path, about, step: 0, done: [], under: true })
export const stepAt = ({ path, step }: Progress) => kSteps[path].at(step)
export const isOver = ({ path, step }: Progress) => step >= kSteps[path].length

/** Goes to another step, the one before the first or after the last being none. */
export function goTo(progress: Progress, step: number): Progress {
  const { met: _, before: __, ...rest } = progress
  return { ...rest, step: Math.min(kSteps[progress.path].length, Math.max(0, step)) }
}
/** The step is done, and the next one begins. */
export function finish(progress: Progress): Progress {
  return goTo(marked(progress), progress.step + 1)
}
function marked(progress: Progress): Progress {
  const id = stepAt(progress)?.id
  return !id || progress.done.includes(id) ? progress : { ...progress, done: [...progress.done, id] }
}

/** What is known now: a step that has just been done is over; one that was done before it began waits for the user. The same where nothing changed. */
export function looked(progress: Progress, facts: Omit<Facts, 'recordingsBefore'>): Progress {
  const step = stepAt(progress)
  if (!step) return progress
  const before = progress.before ?? facts.recordings
  const is = step.done?.({ ...facts, recordingsBefore: before }) ?? false
  if (is && progress.met === false) return finish(progress)
  if (progress.met !== undefined) return progress
  return { ...(is ? marked(progress) : progress), met: is, before }
}

/** What was kept as text; none where it is something else. */
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
    // What was not done yet is recognised after a reload, too.
    return read.step === step && met === false && Number.isInteger(before) ? { ...read, met, before } : read
  } catch {
    return undefined
  }
}
