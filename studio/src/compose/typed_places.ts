import { tokensOf, type Glosses } from './complete'
import { signPlace, type Place } from './project'
import { canBeTyped, placesOf, UtteranceFault } from './utterance'

/**
 * Returns the places of a text in a box for one gloss: the whole text as a gloss, spaces included, if it is known, otherwise the places of an utterance. Throws
 * UtteranceFault.
 */
export function typedPlaces(text: string, glosses: Glosses): readonly Place[] {
  const whole = text.trim()
  if (canBeTyped(whole) && tokensOf(glosses, whole) !== undefined) return [signPlace(whole)]
  const places = placesOf(whole)
  if (places.length === 0) throw new UtteranceFault('emptyName', 0, '', whole)
  return places
}
