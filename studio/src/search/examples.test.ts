import { expect, it } from 'vitest'
import { examplesFor, kExamples } from './examples'

it('has them all where the database has what they name', () => {
  const glosses = ['VANNES', 'MATIN', 'BROUILLARD'].map((gloss) => ({ gloss, tokens: 1 }))
  expect(examplesFor({ glosses, recordings: ['villes'] })).toEqual(kExamples)
  expect(examplesFor(undefined)).toEqual(kExamples)
})

it('asks for the most frequent gloss of another database, and for nothing that it does not have', () => {
  const texts = examplesFor({
    glosses: [
      { gloss: 'A', tokens: 2 },
      { gloss: 'B "C"', tokens: 7 },
    ],
    recordings: ['x'],
  }).map(({ text }) => text)
  expect(texts[0]).toBe('gloss = "B \\"C\\""')
  expect(texts).toContain('gloss = $X ->[..20s] gloss = $X')
  expect(texts.join()).not.toMatch(/VANNES|MATIN|villes/)
})

it('says each in both languages', () => {
  for (const { en, fr } of kExamples) expect(en && fr && en !== fr).toBeTruthy()
})
