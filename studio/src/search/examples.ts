import { quoted } from './answers'
import type { Words } from './complete'
import { scan } from './scan'

/** Queries for who does not know the language: what they ask, and that in the language. All find something in the demo; docs/query.md tells more. */
export interface Example {
  readonly text: string
  readonly en: string
  readonly fr: string
}

export const kExamples: readonly Example[] = [
  { text: 'gloss = "VANNES"', en: 'All tokens of a gloss', fr: 'Toutes les occurrences d’une glose' },
  { text: 'gloss =~ /NUAGE.*|BROUILLARD/', en: 'Glosses by an expression', fr: 'Gloses par une expression' },
  { text: 'gloss = "VANNES" & phase = stroke', en: 'Only their strokes', fr: 'Leurs strokes seulement' },
  { text: 'phase = stroke & duration > 500ms', en: 'Long strokes', fr: 'Strokes longs' },
  { text: 'gloss = "MATIN" ->[..500ms] gloss = "BROUILLARD"', en: 'One sign soon after another', fr: 'Un signe peu après un autre' },
  { text: 'gloss = $X ->[..20s] gloss = $X', en: 'A sign that comes again within 20 s', fr: 'Un signe qui revient avant 20 s' },
  { text: 'phase = stroke & speed(hand) > 70 cm/s', en: 'The hand moves fast', fr: 'La main va vite' },
  { text: 'phase = stroke & end(hand).height > shoulder', en: 'The hand ends above the shoulders', fr: 'La main finit au-dessus des épaules' },
  { text: 'phase = stroke & track(jawOpen) > 0.4', en: 'The mouth is open', fr: 'La bouche est ouverte' },
  { text: 'phase = stroke & like("villes"@1810..2390)', en: 'Moves like this piece', fr: 'Bouge comme ce morceau' },
  { text: 'unit & duration > 8s', en: 'Long stretches between two rests', fr: 'Longues suites entre deux repos' },
]

const kGloss = 'VANNES'

/** The examples that make sense in a database: of its own glosses the most frequent stands in, and what names something else is left out. */
export function examplesFor(words: Pick<Words, 'glosses' | 'recordings'> | undefined): readonly Example[] {
  if (!words) return kExamples
  const known = new Set([...words.glosses.map(({ gloss }) => gloss), ...words.recordings])
  const frequent = words.glosses.reduce<{ gloss: string; tokens: number } | undefined>(
    (most, one) => (most && most.tokens >= one.tokens ? most : one),
    undefined,
  )
  return kExamples.flatMap((example) => {
    const names = scan(example.text)
      .filter(({ kind }) => kind === 'text')
      .map(({ text }) => text)
    const unknown = names.filter((name) => !known.has(name))
    if (unknown.length === 0) return [example]
    if (!frequent || unknown.some((name) => name !== kGloss)) return []
    return [{ ...example, text: example.text.replace(quoted(kGloss), () => quoted(frequent.gloss)) }]
  })
}
