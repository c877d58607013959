import type { Answer } from './answers'
import type { Choice } from './choice'

/** The state of a search outside the address, when it was left for another page. */
export interface Left {
  readonly hash: string
  readonly chosen: readonly Answer[]
  /** Whether the list had the focus. */ readonly focused: boolean
}

let left: Left | undefined

export function leave(as: Left): void {
  left = as
}
/** Returns the state in which the search of an address was left; only once. */
export function comeBack(hash: string): Left | undefined {
  const found = left?.hash === hash ? left : undefined
  if (found) left = undefined
  return found
}

/** Returns the previously selected answers that are unchanged. */
export function chosenAgain(chosen: readonly Answer[], answers: readonly Answer[]): Choice {
  return new Set(
    chosen.flatMap(({ at, recording, name, begin, end }) => {
      const one = answers[at] as Answer | undefined
      return one && one.recording === recording && one.name === name && one.begin === begin && one.end === end ? at : []
    }),
  )
}
