import { expect, it } from 'vitest'
import { examplesFor } from './examples'

const texts = (...from: Parameters<typeof examplesFor>) => examplesFor(...from).map(({ text }) => text)

it("are built from the database's content", () => {
  const found = texts({
    glosses: [
      { gloss: 'NUAGES', tokens: 2 },
      { gloss: 'VANNES', tokens: 3 },
      { gloss: 'NUAGEUX', tokens: 1 },
    ],
    recordings: ['meteo', 'villes'],
    tracks: ['browUp', 'jawOpen'],
  })
  expect(found.slice(0, 4)).toEqual(['vannes', 'gloss = "VANNES" & phase = stroke', 'gloss =~ /NUA.*/', 'recording = "meteo" & phase = stroke'])
  expect(found).toContain('phase = stroke & track(jawOpen) > 0.4')
})

it('writes a gloss of several words as words', () => {
  expect(texts({ glosses: [{ gloss: 'LE MANS', tokens: 7 }], recordings: [], tracks: [] })[0]).toBe('le mans')
})

it('quotes a gloss that does not read as a word, and uses nothing that does not exist', () => {
  const found = texts({ glosses: [{ gloss: 'B "C"', tokens: 7 }], recordings: ['x'], tracks: [] })
  expect(found[0]).toBe('"B \\"C\\""')
  expect(found.join()).not.toMatch(/track|=~/)
})

it('names nothing if nothing is known', () => {
  expect(texts(undefined).join()).not.toMatch(/"/)
  expect(texts(undefined).length).toBeGreaterThan(3)
})

it('describes each in both languages', () => {
  for (const { en, fr } of examplesFor(undefined)) expect(en && fr && en !== fr).toBeTruthy()
})
