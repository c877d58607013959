import { joinTexts } from './joins'
import { isPlain, kHow, type Place, type Project } from './project'
import { textOf } from './utterance'

/** The parameters of `POST …/sign`. */
export interface SignBody {
  readonly utterance: string
  readonly transition?: string
  readonly duration?: string | number
  readonly tempo?: number
  readonly align?: string
  readonly rate?: string
  readonly junctions?: readonly string[]
}

/** The call that signs a project; what the server would take anyway is left out. */
export function bodyOf({ places, how }: Project): SignBody {
  const junctions = joinTexts(places)
  return {
    utterance: textOf(places),
    ...(how.transition !== kHow.transition && { transition: how.transition }),
    ...(how.duration !== kHow.duration && { duration: how.duration }),
    ...(how.tempo !== kHow.tempo && { tempo: how.tempo }),
    ...(how.align !== kHow.align && { align: how.align }),
    ...(how.rate !== kHow.rate && { rate: how.rate }),
    ...(junctions.length > 0 && { junctions }),
  }
}

/** The same project with every junction made by one method, its durations and tempos as they are. */
export function byMethod(project: Project, method: string): Project {
  const without = (place: Place): Place => {
    if (isPlain(place.join)) return place
    const { method: _, ...join } = place.join
    return { ...place, join }
  }
  return { ...project, how: { ...project.how, transition: method }, places: project.places.map(without) }
}

/** The same project with every sign the token that `tokens` names for its place; 0 leaves it open. */
export function pinned(project: Project, tokens: readonly number[]): Project {
  return { ...project, places: project.places.map((place, k) => (place.kind === 'sign' && place.token === 0 ? { ...place, token: tokens[k] ?? 0 } : place)) }
}
