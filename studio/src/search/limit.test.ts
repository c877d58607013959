import { expect, it } from 'vitest'
import { isRanked, nearestOf } from './limit'

it('recognizes queries that return the nearest answers', () => {
  expect(isRanked('phase = stroke & like("meteo"@0..100)')).toBe(true)
  expect(isRanked('gloss = "like("')).toBe(false)
  expect(isRanked('gloss = like')).toBe(false)
})

it('accepts only the numbers to choose from', () => expect(['500', 'x', undefined].map(nearestOf)).toEqual([500, 100, 100]))
