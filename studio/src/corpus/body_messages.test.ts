import { expect, it } from 'vitest'
import { kFingerParts, kMainParts, partName } from './body_messages'

it('has names for every part that the server knows', () => {
  expect([kMainParts.length, kFingerParts.length]).toEqual([25, 50])
  expect(partName('left_hand', 'en')).toBe('left wrist')
  expect(partName('right_index_tip', 'fr')).toBe('index, bout à droite')
  for (const part of [...kMainParts, ...kFingerParts])
    for (const language of ['en', 'fr'] as const) {
      expect(partName(part, language)).not.toMatch(/_|undefined/)
    }
})
