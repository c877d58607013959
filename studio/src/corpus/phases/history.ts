const kMost = 500

/** The past states, the current one, and the undone ones. */
export interface History<T> {
  readonly past: readonly T[]
  readonly now: T
  readonly undone: readonly T[]
}

export const begun = <T>(now: T): History<T> => ({ past: [], now, undone: [] })
/** Adds a state; an identical state changes nothing. */
export function pushed<T>(history: History<T>, now: T): History<T> {
  return now === history.now ? history : { past: [...history.past, history.now].slice(-kMost), now, undone: [] }
}
export function undone<T>({ past, now, undone: later }: History<T>): History<T> {
  return past.length === 0 ? { past, now, undone: later } : { past: past.slice(0, -1), now: past.at(-1)!, undone: [now, ...later] }
}
export function redone<T>({ past, now, undone: later }: History<T>): History<T> {
  return later.length === 0 ? { past, now, undone: later } : { past: [...past, now], now: later[0], undone: later.slice(1) }
}
