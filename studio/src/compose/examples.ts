import { signPlace, withPlaces, type Place, type Project } from './project'
import { tokensOf, type Glosses } from './complete'

/** A sign of a recording: a gloss, and its occurrence in the recording, from 1. */
type Own = readonly [gloss: string, token: number]
/** A scenario of the paper (section 5.1): signs of a recording that are replaced, or two runs of signs that are swapped. */
export interface Scenario {
  readonly name: 'scenario1' | 'scenario2'
  readonly recording: string
  readonly replace?: readonly { readonly from: Own; readonly by: string }[]
  readonly swap?: readonly [{ readonly first: Own; readonly last: Own }, { readonly first: Own; readonly last: Own }]
}

export const kScenarios: readonly Scenario[] = [
  {
    name: 'scenario1',
    recording: 'meteo',
    replace: [
      { from: ['BRETAGNE', 1], by: 'VANNES' },
      { from: ['DEMAIN', 1], by: 'MARSEILLE' },
      { from: ['VENDREDI', 1], by: 'RENNES' },
      { from: ['MATIN', 2], by: 'LE MANS' },
    ],
  },
  {
    name: 'scenario2',
    recording: 'meteo',
    swap: [
      { first: ['BRETAGNE', 1], last: ['PLUIE', 1] },
      { first: ['NUAGES', 2], last: ['BROUILLARD', 1] },
    ],
  },
]

/** Returns whether a database has what a scenario needs. */
export function isThere({ recording, replace, swap }: Scenario, recordings: readonly string[], glosses: Glosses): boolean {
  const wanted = [...(replace ?? []).flatMap(({ from, by }) => [from[0], by]), ...(swap ?? []).flatMap(({ first, last }) => [first[0], last[0]])]
  return recordings.includes(recording) && wanted.every((gloss) => tokensOf(glosses, gloss) !== undefined)
}

/** Applies a scenario to a recording. Returns undefined if the recording lacks one of its signs, or if its runs overlap. */
export function played(scenario: Scenario, recording: Project): Project | undefined {
  const { places } = recording
  // A place that is a piece, for lack of a token, has no gloss to search for; the scenarios' own signs are all tokens.
  const find = ([gloss, token]: Own): number => {
    let count = 0
    return places.findIndex((place) => place.kind === 'sign' && place.gloss === gloss && ++count === token)
  }
  if (scenario.swap) {
    const [a, b] = scenario.swap.map(({ first, last }) => ({ begin: find(first), end: find(last) + 1 })).sort((x, y) => x.begin - y.begin)
    if (a.begin < 0 || a.end <= a.begin || b.begin < a.end || b.end <= b.begin) return undefined
    const run = (from: number, to?: number) => places.slice(from, to)
    return withPlaces(recording, [...run(0, a.begin), ...run(b.begin, b.end), ...run(a.end, b.begin), ...run(a.begin, a.end), ...run(b.end)])
  }
  const by = new Map<number, Place>()
  for (const { from, by: gloss } of scenario.replace ?? []) by.set(find(from), signPlace(gloss))
  return by.has(-1)
    ? undefined
    : withPlaces(
        recording,
        places.map((place, k) => by.get(k) ?? place),
      )
}
