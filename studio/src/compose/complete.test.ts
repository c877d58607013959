import { expect, it } from 'vitest'
import { completions, glossesOf, tokensOf, wordAt } from './complete'

const glosses = glossesOf(['ÉTÉ', 'LE MANS', 'MATIN', 'MARSEILLE', 'ETAGE', 'APRES-MIDI', 'DEMAIN'].map((gloss, k) => ({ gloss, tokens: k + 1 })))
const found = (typed: string, most?: number) => completions(glosses, typed, most).map(({ gloss }) => gloss)

it('finds glosses that begin with the word, then those that contain it, ignoring accents', () => {
  expect(found('ma')).toEqual(['MARSEILLE', 'MATIN', 'DEMAIN', 'LE MANS'])
  expect(found('été')).toEqual(['ÉTÉ'])
  expect(found('et')).toEqual(['ETAGE', 'ÉTÉ'])
  expect(found('midi')).toEqual(['APRES-MIDI'])
  expect(found('', 2)).toEqual(['APRES-MIDI', 'DEMAIN'])
  expect(found('ma', 3)).toHaveLength(3)
  expect(found('zzz')).toEqual([])
})

it('compares glosses as the server does: every letter counts, in any Unicode composition', () => {
  expect([tokensOf(glosses, 'ÉTÉ'.normalize('NFD')), tokensOf(glosses, ' MATIN '), tokensOf(glosses, 'matin')]).toEqual([1, 3, undefined])
})

it('is fast among ten thousand glosses', () => {
  const many = glossesOf(Array.from({ length: 10_000 }, (_, k) => ({ gloss: `GLOSE-${(k * 7919) % 10_000}-É`, tokens: 1 })))
  const start = performance.now()
  for (let i = 0; i < 100; ++i) completions(many, `${i}`)
  expect((performance.now() - start) / 100).toBeLessThan(8) // one frame at 60 Hz takes 16 ms
})

it('finds the word at the caret, including quotes', () => {
  expect(wordAt('VANNES MAT', 10)).toEqual({ from: 7, to: 10, typed: 'MAT' })
  expect(wordAt('VANNES MATIN PLUIE', 9)).toEqual({ from: 7, to: 12, typed: 'MA' })
  expect(wordAt('A "LE MANS" B', 6)).toEqual({ from: 2, to: 11, typed: 'LE ' })
  expect(wordAt('A "LE MA', 8)).toEqual({ from: 2, to: 8, typed: 'LE MA' })
  expect(wordAt('A "LE MANS"#2', 13)).toEqual({ from: 2, to: 13, typed: 'LE MANS' })
  expect([wordAt('MATIN#', 6), wordAt('MATIN#2', 7), wordAt('A ', 2)].map(({ typed }) => typed)).toEqual(['MATIN', 'MATIN', ''])
})
