import { bodyOf, type SignBody } from './body'
import { tokensOf, type Glosses } from './complete'
import { withPlaces, withToken, type Place, type Project } from './project'

/** The call that tells what the tokens of a place cost, and which place of that call it is. */
export interface Asking {
  readonly body: SignBody
  readonly at: number
}

/**
 * Asks of a place, left open, without those beside it that a database does not know: one of them would spoil the call. None where the
 * place is no sign, or is not known itself. `glosses` and `recordings` may still be to come.
 */
export function askingOf(project: Project, at: number, glosses: Glosses | undefined, recordings: ReadonlyMap<string, unknown>): Asking | undefined {
  const open = withToken(project, at, 0)
  const isThere = (place: Place): boolean => {
    if (place.kind === 'piece') return recordings.size === 0 || recordings.has(place.recording)
    const tokens = glosses ? tokensOf(glosses, place.gloss) : Infinity
    return tokens !== undefined && place.token <= tokens
  }
  const place = open.places[at]
  if (place?.kind !== 'sign' || !isThere(place)) return undefined
  const places = open.places.filter(isThere)
  return { body: bodyOf(withPlaces(open, places)), at: places.indexOf(place) }
}
