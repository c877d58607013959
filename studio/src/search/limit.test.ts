import { expect, it } from 'vitest'
import { isRanked, nearestOf } from './limit'

it('knows which queries give the nearest', () => {
  expect(isRanked('phase = stroke & like("meteo"@0..100)')).toBe(true)
  expect(isRanked('gloss = "like("')).toBe(false)
  expect(isRanked('gloss = like')).toBe(false)
})

it('asks for as many as can be chosen', () => expect(['500', 'x', undefined].map(nearestOf)).toEqual([500, 100, 100]))
