import { isPlain, kLongestMs, kTempo, type Join, type Place } from './project'

/**
 * Returns the settings of single junctions in the server's syntax: `N=PART,PART`, where N is the junction (1 is between the first and the second place) and a
 * part is a method, `450ms`, or a tempo `x1.5`.
 */
export function joinTexts(places: readonly Place[]): string[] {
  return places.flatMap(({ join }, k) => (k === 0 || isPlain(join) ? [] : [`${k}=${joinText(join)}`]))
}

export function joinText({ method, durationMs, tempo }: Join): string {
  return [method, durationMs === undefined ? undefined : `${durationMs}ms`, tempo === undefined ? undefined : `x${tempo}`]
    .filter((part) => part !== undefined)
    .join(',')
}

/** Parses the number of a junction and its settings; undefined if the text does not match. */
export function readJoin(text: string): { junction: number; join: Join } | undefined {
  const [, number, parts] = /^(\d{1,9})=(.+)$/s.exec(text) ?? []
  if (!number || Number(number) < 1) return undefined
  const join: { method?: string; durationMs?: number; tempo?: number } = {}
  for (const part of parts.split(',')) {
    const ms = /^(\d{1,6})ms$/.exec(part)?.[1],
      tempo = /^x(\d+(?:\.\d+)?)$/.exec(part)?.[1]
    if (ms !== undefined) join.durationMs = Number(ms)
    else if (tempo !== undefined) join.tempo = Number(tempo)
    else if (isMethod(part)) join.method = part
    else return undefined
  }
  return isJoin(join) ? { junction: Number(number), join } : undefined
}

/** Method names are plain words, so that they can be listed. */
export const isMethod = (text: unknown): text is string => typeof text === 'string' && /^[a-z][a-z0-9_-]*$/i.test(text)
export const isDuration = (value: unknown): value is number => Number.isInteger(value) && (value as number) >= 0 && (value as number) <= kLongestMs
export const isTempo = (value: unknown): value is number => typeof value === 'number' && value >= kTempo.least && value <= kTempo.most

function isJoin({ durationMs, tempo }: Join): boolean {
  return (durationMs === undefined || isDuration(durationMs)) && (tempo === undefined || isTempo(tempo))
}
