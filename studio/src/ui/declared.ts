import { kPlaceholder } from '../motion/declarations'
import type { Text } from '../text/en'
import type { Language } from './preferences.svelte'

/** Returns the text of a declaration: signweave's own declarations are translated; all others are shown as written. */
export function declared(name: string, value: string, language: Language, text: Text): string {
  return name === kPlaceholder && language !== 'en' ? `${text.placeholder} (${value})` : value
}
