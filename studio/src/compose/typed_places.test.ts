import { expect, it } from 'vitest'
import { glossesOf } from './complete'
import { readGlosses } from './test_places'
import { typedPlaces } from './typed_places'
import { textOf } from './utterance'

const glosses = glossesOf([
  { gloss: 'LE MANS', tokens: 1 },
  { gloss: 'A#3', tokens: 1 },
])

it('takes the text for a known gloss, and has any other read', async () => {
  const read = async (text: string) => textOf(await typedPlaces(text, glosses, readGlosses))
  expect(await Promise.all([' LE MANS ', 'A#3', 'A B'].map(read))).toEqual(['"LE MANS"', '"A#3"', 'A B'])
  await expect(read('"LE MANS')).rejects.toThrow('open_quote')
  await expect(read('  ')).rejects.toThrow('empty_name')
})
