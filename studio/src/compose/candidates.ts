import type { Candidate } from '../api/schema'
import type { ExplainedSynthesis } from '../api/types'

interface Term {
  readonly name: string
  readonly of: 'target' | 'join'
  readonly cost: number
}
/** A token that may fill a place, with its costs. */
export interface CandidateToken {
  readonly token: number
  readonly recording: string
  /** The frame of its recording at which it begins. */
  readonly frame: number
  readonly cost: number
  /** The cost of the token alone, and of its join to the previous sign; the first place has no join. */
  readonly target: number
  readonly join?: number
  /** It was recorded right after the previous sign, and that transition is kept. */
  readonly kept: boolean
  /** The cost terms, by the server's names, without negligible ones; greatest first. */
  readonly terms: readonly Term[]
  /** The candidate with the lowest total cost. */
  readonly best: boolean
}

/** Costs below this are negligible: they would be shown as 0. */
const kNothing = 0.005

/** Returns the candidates of a place, cheapest first. */
export function candidatesOf({ places }: ExplainedSynthesis, place: number): CandidateToken[] {
  const { candidates, chosen } = places[place]
  return candidates.map((row, k) => candidateOf(row, k === chosen)).sort((a, b) => a.cost - b.cost || a.token - b.token)
}

function candidateOf({ token, recording, frames, cost, target_cost, target, kept, join_cost, join }: Candidate, best: boolean): CandidateToken {
  // Of the join to the next sign only the total is reported.
  const after = cost - target_cost - (join_cost ?? 0)
  const terms = [...termsOf(target, 'target'), ...(kept ? [] : termsOf(join ?? {}, 'join')), ...termsOf({ after }, 'join')].sort((a, b) => b.cost - a.cost)
  return { token, recording, frame: frames.begin, cost, target: target_cost, join: join_cost, kept: kept ?? false, terms, best }
}

function termsOf(terms: Readonly<Record<string, number>>, of: Term['of']): Term[] {
  return Object.entries(terms)
    .filter(([, cost]) => cost >= kNothing)
    .map(([name, cost]) => ({ name, of, cost }))
}

/** Returns the token chosen for each place; 0 for a piece. */
export function chosenTokens({ places }: ExplainedSynthesis): number[] {
  return places.map(({ candidates, chosen }) => candidates[chosen]?.token ?? 0)
}
