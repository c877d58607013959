import { kPlaceholder } from '../motion/declarations'
import type { Text } from '../text/en'
import type { Language } from './preferences.svelte'

/** What is declared, in words: what signweave itself declares is known in both languages; all else is shown as it was written. */
export function declared(name: string, value: string, language: Language, text: Text): string {
  return name === kPlaceholder && language !== 'en' ? `${text.placeholder} (${value})` : value
}
