import type { Answer } from './answers'

/** The selected answers, by index, in the order of selection. */
export type Choice = ReadonlySet<number>

/** Toggles the selection of one answer. */
export function toggled(choice: Choice, at: number): Choice {
  const next = new Set(choice)
  if (!next.delete(at)) next.add(at)
  return next
}

/** Adds all answers between two rows of a list, both included, in the direction from the first. */
export function withRange(choice: Choice, list: readonly Answer[], from: number, to: number): Choice {
  const next = new Set(choice)
  const step = from <= to ? 1 : -1
  for (let i = from; i !== to + step; i += step) if (list[i]) next.add(list[i].at)
  return next
}

/** Returns the selected answers, in the order of selection. */
export function chosenOf(choice: Choice, answers: readonly Answer[]): readonly Answer[] {
  return [...choice].flatMap((at) => answers[at] ?? [])
}
