/** A state with the previous states (`past`, oldest first) and the undone states (`future`, next first). Immutable. */
export interface History<T> {
  readonly past: readonly T[]
  readonly now: T
  readonly future: readonly T[]
  /** The subject of the newest change and its time: changes of one subject in quick succession are one step. */
  readonly of?: string
  readonly at: number
}

const kMostSteps = 500
/** Changes of one subject within this many ms of each other are undone together. */
const kOneGoMs = 1500

export function begun<T>(now: T): History<T> {
  return { past: [], now, future: [], at: -Infinity }
}

/** Adds a state. `of` names the subject of the change, so that several changes of it can be one step; `at` is in ms of any clock. */
export function did<T>(history: History<T>, now: T, of?: string, at = 0): History<T> {
  if (now === history.now) return history
  const goesOn = of !== undefined && of === history.of && at - history.at < kOneGoMs
  const past = goesOn ? history.past : [...history.past.slice(-kMostSteps + 1), history.now]
  return { past, now, future: [], of, at }
}

export function undone<T>(history: History<T>): History<T> {
  const { past, now, future } = history
  if (past.length === 0) return history
  return { past: past.slice(0, -1), now: past[past.length - 1], future: [now, ...future], at: -Infinity }
}

export function redone<T>(history: History<T>): History<T> {
  const { past, now, future } = history
  if (future.length === 0) return history
  return { past: [...past, now], now: future[0], future: future.slice(1), at: -Infinity }
}
