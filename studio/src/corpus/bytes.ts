import { number } from '../ui/preferences.svelte'

/** The names of size units. */
export interface SizeUnits {
  readonly bytes: string
  readonly kB: string
  readonly MB: string
  readonly GB: string
}

/** Formats a size for people: two or three digits. */
export function size(bytes: number, units: SizeUnits): string {
  if (bytes < 1000) return `${number(bytes)} ${units.bytes}`
  const [unit, of] = bytes < 1e6 ? [units.kB, 1e3] : bytes < 1e9 ? [units.MB, 1e6] : [units.GB, 1e9]
  const value = bytes / of
  return `${number(value, value < 10 ? 1 : 0)} ${unit}`
}
