import { scan } from './scan'

/** How many of the nearest are asked for where the query has `like(…)`; all else gives all that there are. */
export const kNearest = [20, 100, 500, 5000] as const
export const kUsual = 100

/** Whether answers come by their distance from a piece. */
export function isRanked(text: string): boolean {
  const tokens = scan(text)
  return tokens.some(({ kind, text: word }, i) => kind === 'word' && word === 'like' && tokens[i + 1]?.text === '(')
}

/** The number in the address, where it is one that can be chosen. */
export function nearestOf(said: string | undefined): number {
  return kNearest.find((one) => String(one) === said) ?? kUsual
}
