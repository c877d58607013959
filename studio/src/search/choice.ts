import type { Answer } from './answers'

/** Which answers are chosen, by their numbers, in the order in which they were chosen. */
export type Choice = ReadonlySet<number>

/** The other way round for one. */
export function toggled(choice: Choice, at: number): Choice {
  const next = new Set(choice)
  if (!next.delete(at)) next.add(at)
  return next
}

/** With all between two rows of a list, both included, in the list's order from the first named. */
export function withRange(choice: Choice, list: readonly Answer[], from: number, to: number): Choice {
  const next = new Set(choice)
  const step = from <= to ? 1 : -1
  for (let i = from; i !== to + step; i += step) if (list[i]) next.add(list[i].at)
  return next
}

/** The chosen ones of all answers, in the order in which they were chosen. */
export function chosenOf(choice: Choice, answers: readonly Answer[]): readonly Answer[] {
  return [...choice].flatMap((at) => answers[at] ?? [])
}
