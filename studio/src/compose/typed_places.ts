import { tokensOf, type Glosses } from './complete'
import { signPlace, type Place } from './project'
import { canBeTyped, UtteranceFault, type ReadText } from './utterance'

/**
 * Returns the places of a text in a box for one gloss: the whole text as a gloss, spaces included, if it is known, otherwise the places of an utterance. Throws
 * UtteranceFault, or what `read` throws.
 */
export async function typedPlaces(text: string, glosses: Glosses, read: ReadText, signal?: AbortSignal): Promise<readonly Place[]> {
  const whole = text.trim()
  if (canBeTyped(whole) && tokensOf(glosses, whole) !== undefined) return [signPlace(whole)]
  const { places } = await read(whole, signal)
  if (places.length === 0)
    throw new UtteranceFault(whole, { code: 'empty_name', message: 'an empty name', line: 1, column: 1, begin: 0, end: [...whole].length })
  return places
}
