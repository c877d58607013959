import { bodyOf, type SignBody } from './body'
import { tokensOf, type Glosses } from './complete'
import { withPlaces, withToken, type Place, type Project } from './project'

/** The call that returns the costs of the tokens of a place, and the index of the place in that call. */
export interface Asking {
  readonly body: SignBody
  readonly at: number
}

/**
 * Builds the call for one place, with its token left open and without neighbours unknown to the database, any of which would fail the call. Returns undefined
 * if the place is no sign or is unknown itself. `glosses` and `recordings` may not be loaded yet.
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
