import type { CandidateRow, ExplainedReport } from '../api/answers'

interface Term {
  readonly name: string
  readonly of: 'target' | 'join'
  readonly cost: number
}
/** A token that may fill a place, with what speaks against it. */
export interface Candidate {
  readonly token: number
  readonly recording: string
  /** Frame of its recording that it begins at. */
  readonly frame: number
  readonly cost: number
  /** What stands alone, and its join to the sign before; none of the first place. */
  readonly target: number
  readonly join?: number
  /** It was recorded right after the sign before, and that transition is kept. */
  readonly kept: boolean
  /** What the costs are made of, by the server's names, without what is nothing; the greatest first. */
  readonly terms: readonly Term[]
  /** The one that costs least with all the others. */
  readonly best: boolean
}

/** Costs below this say nothing: they would be shown as 0. */
const kNothing = 0.005

/** The candidates of a place, the cheapest first. */
export function candidatesOf({ places }: ExplainedReport, place: number): Candidate[] {
  const { candidates, chosen } = places[place]
  return candidates.map((row, k) => candidateOf(row, k === chosen)).sort((a, b) => a.cost - b.cost || a.token - b.token)
}

function candidateOf({ token, recording, frames, cost, target_cost, target, kept, join_cost, join }: CandidateRow, best: boolean): Candidate {
  // Of the join to the sign after it only the whole is told.
  const after = cost - target_cost - (join_cost ?? 0)
  const terms = [...termsOf(target, 'target'), ...(kept ? [] : termsOf(join ?? {}, 'join')), ...termsOf({ after }, 'join')].sort((a, b) => b.cost - a.cost)
  return { token, recording, frame: frames.begin, cost, target: target_cost, join: join_cost, kept: kept ?? false, terms, best }
}

function termsOf(terms: Readonly<Record<string, number>>, of: Term['of']): Term[] {
  return Object.entries(terms)
    .filter(([, cost]) => cost >= kNothing)
    .map(([name, cost]) => ({ name, of, cost }))
}

/** The token that was chosen for each place; 0 of a piece. */
export function chosenTokens({ places }: ExplainedReport): number[] {
  return places.map(({ candidates, chosen }) => candidates[chosen]?.token ?? 0)
}
