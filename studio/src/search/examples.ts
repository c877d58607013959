import { quoted } from './answers'
import type { Words } from './complete'

/** Queries for who does not know the language: what they ask, and that in the language. */
export interface Example {
  readonly text: string
  readonly en: string
  readonly fr: string
}

/** Examples made of what a database has, so that each can find something there; docs/query.md tells more. Without `words` those that name nothing. */
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
            en: 'A word: signs of that gloss, however it is spelt',
            fr: 'Un mot\u202f: les signes de cette glose, quelle que soit l’orthographe',
          },
          { text: `gloss = ${quoted(frequent)} & phase = stroke`, en: 'Only the strokes of a gloss', fr: 'Seulement les strokes d’une glose' },
        ]),
    ...(begin === undefined ? [] : [{ text: `gloss =~ /${begin}.*/`, en: 'Glosses by an expression', fr: 'Gloses par une expression' }]),
    ...(recording === undefined
      ? []
      : [{ text: `recording = ${quoted(recording)} & phase = stroke`, en: 'In one recording only', fr: 'Dans un seul enregistrement' }]),
    { text: 'phase = stroke & duration > 500ms', en: 'Long strokes', fr: 'Strokes longs' },
    { text: 'gloss = $X ->[..20s] gloss = $X', en: 'A sign that comes again within 20 s', fr: 'Un signe qui revient avant 20 s' },
    { text: 'phase = stroke & speed(hand) > 70 cm/s', en: 'The hand moves fast', fr: 'La main va vite' },
    { text: 'phase = stroke & max(hand).height > shoulder', en: 'The hand goes above the shoulders', fr: 'La main passe au-dessus des épaules' },
    ...(track === undefined
      ? []
      : [{ text: `phase = stroke & track(${track}) > 0.4`, en: 'The face: a track of it is high', fr: 'Le visage\u202f: une de ses pistes est haute' }]),
    { text: 'unit & duration > 8s', en: 'Long stretches between two rests', fr: 'Longues suites entre deux repos' },
  ]
}

/** A gloss as one types it: bare where it reads as words alone. */
function asWords(gloss: string): string {
  return /^[\p{L}\p{N}][\p{L}\p{N}'’ -]*$/u.test(gloss) ? gloss.toLowerCase() : quoted(gloss)
}

/** Three letters with which several glosses begin, the most frequent of them. */
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
