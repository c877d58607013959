import { quoted } from './answers'
import type { Words } from './complete'

/** An example query for users who do not know the language: its description, and its text. */
export interface Example {
  readonly text: string
  readonly en: string
  readonly fr: string
}

/**
 * Returns examples built from a database's content, so that each can find something; docs/query.md explains more. Without `words`, only those that name
 * nothing.
 */
export function examplesFor(words: Pick<Words, 'glosses' | 'recordings' | 'tracks'> | undefined): readonly Example[] {
  const glosses = [...(words?.glosses ?? [])].sort((a, b) => b.tokens - a.tokens)
  const frequent = glosses[0]?.gloss
  const begin = beginning(glosses)
  const track = words?.tracks?.includes('jawOpen') ? 'jawOpen' : words?.tracks?.[0]
  const recording = words?.recordings[0]
  return [
    ...(frequent === undefined
      ? []
      : [
          {
            text: asWords(frequent),
            en: 'A word: signs of that gloss, in any spelling',
            fr: 'Un mot\u202f: les signes de cette glose, quelle que soit l’orthographe',
          },
          { text: `gloss = ${quoted(frequent)} & phase = stroke`, en: 'Only the strokes of a gloss', fr: 'Seulement les strokes d’une glose' },
        ]),
    ...(begin === undefined ? [] : [{ text: `gloss =~ /${begin}.*/`, en: 'Glosses matching a regular expression', fr: 'Gloses par une expression régulière' }]),
    ...(recording === undefined
      ? []
      : [{ text: `recording = ${quoted(recording)} & phase = stroke`, en: 'In one recording only', fr: 'Dans un seul enregistrement' }]),
    { text: 'phase = stroke & duration > 500ms', en: 'Long strokes', fr: 'Strokes longs' },
    { text: 'gloss = $X ->[..20s] gloss = $X', en: 'A sign repeated within 20 s', fr: 'Un signe répété en moins de 20 s' },
    { text: 'phase = stroke & speed(hand) > 70 cm/s', en: 'The hand moves fast', fr: 'La main bouge vite' },
    { text: 'phase = stroke & max(hand).height > shoulder', en: 'The hand goes above the shoulders', fr: 'La main passe au-dessus des épaules' },
    ...(track === undefined
      ? []
      : [{ text: `phase = stroke & track(${track}) > 0.4`, en: 'The face: a track has a high value', fr: 'Le visage\u202f: une piste a une valeur élevée' }]),
    { text: 'unit & duration > 8s', en: 'Long units between two rests', fr: 'Longues unités entre deux repos' },
  ]
}

/** Returns a gloss as typed: unquoted if it reads as plain words. */
function asWords(gloss: string): string {
  return /^[\p{L}\p{N}][\p{L}\p{N}'’ -]*$/u.test(gloss) ? gloss.toLowerCase() : quoted(gloss)
}

/** Returns three letters with which several glosses begin: the most frequent such letters. */
function beginning(glosses: Words['glosses']): string | undefined {
  const first = ({ gloss }: { gloss: string }) => /^[\p{L}\p{N}]{3}/u.exec(gloss)?.[0]
  const tokens = new Map<string, { glosses: number; tokens: number }>()
  for (const one of glosses) {
    const begin = first(one)
    if (begin === undefined) continue
    const sum = tokens.get(begin) ?? { glosses: 0, tokens: 0 }
    tokens.set(begin, { glosses: sum.glosses + 1, tokens: sum.tokens + one.tokens })
  }
  return [...tokens].filter(([, sum]) => sum.glosses > 1).sort(([, a], [, b]) => b.tokens - a.tokens)[0]?.[0]
}
