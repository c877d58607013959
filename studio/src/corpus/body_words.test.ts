import { expect, it } from 'vitest'
import { kFingerParts, kMainParts, partWords } from './body_words'

it('has words for every part that the server knows', () => {
  expect([kMainParts.length, kFingerParts.length]).toEqual([25, 50])
  expect(partWords('left_hand', 'en')).toBe('left wrist')
  expect(partWords('right_index_tip', 'fr')).toBe('index, bout à droite')
  for (const part of [...kMainParts, ...kFingerParts])
    for (const language of ['en', 'fr'] as const) {
      expect(partWords(part, language)).not.toMatch(/_|undefined/)
    }
})
