import { expect, it } from 'vitest'
import { SignedPlaces } from './signed_places.svelte'

it('returns the gloss signed at a frame, and nothing at rest', () => {
  const places = new SignedPlaces()
  places.push(27, 'VANNES')
  places.push(140)
  places.push(200, 'LE MANS')
  expect([0, 27, 139, 140, 250].map((frame) => places.glossAt(frame))).toEqual([undefined, 'VANNES', 'VANNES', undefined, 'LE MANS'])
  expect(places.recent).toBe('VANNES@27 LE MANS@200')
  places.clear()
  expect(places.glossAt(250)).toBe(undefined)
  expect(places.recent).toBe('')
})

it('forgets the oldest of very many, and lists the last few', () => {
  const places = new SignedPlaces()
  for (let i = 0; i <= 2000; ++i) places.push(i, `G${i}`)
  expect(places.glossAt(999)).toBe(undefined)
  expect(places.glossAt(2000)).toBe('G2000')
  expect(places.recent.split(' ')).toHaveLength(20)
})
