import { expect, it } from 'vitest'
import { glossesOf } from './complete'
import { typedPlaces } from './typed_places'
import { textOf } from './utterance'

const glosses = glossesOf([
  { gloss: 'LE MANS', tokens: 1 },
  { gloss: 'A#3', tokens: 1 },
])

it('reads a box for one gloss, with and without quotes', () => {
  expect([' LE MANS ', '"LE MANS"', 'A#3', 'MATIN#2', 'A , B', 'r@1..20'].map((text) => textOf(typedPlaces(text, glosses)))).toEqual([
    '"LE MANS"',
    '"LE MANS"',
    '"A#3"',
    'MATIN#2',
    'A , B',
    'r@1..20',
  ])
  expect(() => typedPlaces('"LE MANS', glosses)).toThrow('noClosingQuote')
  expect(() => typedPlaces(' , ', glosses)).toThrow('emptyName')
})
