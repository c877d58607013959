import { number } from '../ui/preferences.svelte'

/** Words for sizes, by their unit. */
export interface SizeWords {
  readonly bytes: string
  readonly kB: string
  readonly MB: string
  readonly GB: string
}

/** A size as people read it: two or three figures. */
export function size(bytes: number, words: SizeWords): string {
  if (bytes < 1000) return `${number(bytes)} ${words.bytes}`
  const [unit, of] = bytes < 1e6 ? [words.kB, 1e3] : bytes < 1e9 ? [words.MB, 1e6] : [words.GB, 1e9]
  const value = bytes / of
  return `${number(value, value < 10 ? 1 : 0)} ${unit}`
}
