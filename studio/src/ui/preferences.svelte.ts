import { en, type Text } from '../text/en'
import { fr } from '../text/fr'

export type Language = 'en' | 'fr'
export type Theme = 'dark' | 'light'

const kTexts: Record<Language, Text> = { en, fr }

/** Returns the stored value, if it is one of `possible`. */
function stored<T extends string>(key: string, possible: readonly T[]): T | undefined {
  const value = read(key)
  return possible.find((one) => one === value)
}
function read(key: string): string | undefined {
  try {
    return localStorage.getItem(`signweave.${key}`) ?? undefined
  } catch {
    return undefined // if storage is forbidden, the system's settings apply
  }
}
function store(key: string, value: string): void {
  try {
    localStorage.setItem(`signweave.${key}`, value)
  } catch {
    // as above
  }
}

/** Language, theme, keys and character: as chosen before, otherwise as the system prefers. */
class Preferences {
  language = $state<Language>(stored('language', ['en', 'fr']) ?? (navigator.language.startsWith('fr') ? 'fr' : 'en'))
  theme = $state<Theme>(stored('theme', ['dark', 'light']) ?? (matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark'))
  /** Whether letters, digits and symbols act as keyboard shortcuts. Users of speech input switch them off. */
  characterKeys = $state(stored('keys', ['off']) === undefined)
  /** The body: a character's name, or `drawn` for the studio's plain body; undefined if none was chosen yet. */
  body = $state<string | undefined>(read('body'))
  text = $derived(kTexts[this.language])

  setLanguage(language: Language): void {
    this.language = language
    store('language', language)
  }
  setCharacterKeys(on: boolean): void {
    this.characterKeys = on
    store('keys', on ? 'on' : 'off')
  }
  setBody(body: string): void {
    this.body = body
    store('body', body)
  }
  setTheme(theme: Theme): void {
    this.theme = theme
    store('theme', theme)
  }
}

export const preferences = new Preferences()

/** Replaces the placeholders `{…}` of a text. */
export function filled(text: string, values: Readonly<Record<string, string | number>>): string {
  return text.replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole))
}

/** Formats a number in the user's language. */
export function number(value: number, digits = 0): string {
  return value.toLocaleString(preferences.language, { minimumFractionDigits: digits, maximumFractionDigits: digits })
}

export { clock } from './clock'
