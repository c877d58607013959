import { scan } from './scan'

/** The numbers of nearest answers to choose from if the query has `like(…)`; other queries return all answers. */
export const kNearest = [20, 100, 500, 5000] as const
export const kUsual = 100

/** Whether answers are ordered by their distance from a piece. */
export function isRanked(text: string): boolean {
  const tokens = scan(text)
  return tokens.some(({ kind, text: word }, i) => kind === 'word' && word === 'like' && tokens[i + 1]?.text === '(')
}

/** Returns the number in the address, if it is one of the choices. */
export function nearestOf(said: string | undefined): number {
  return kNearest.find((one) => String(one) === said) ?? kUsual
}
