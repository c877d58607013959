import { expect, it } from 'vitest'
import { periodOf, timeIn } from './loops'

it('starts all at once, and shorter ones wait for the longest', () => {
  const period = periodOf('together', [1, 2])
  expect(period).toBeGreaterThan(2)
  expect(timeIn('together', 0.5, 1, period)).toBe(0.5)
  expect(timeIn('together', 1.5, 1, period)).toBe(1)
  expect(timeIn('together', period + 0.25, 1, period)).toBeCloseTo(0.25)
})

it('runs each by itself', () => {
  expect(timeIn('own', 2.5, 1, 9)).toBeCloseTo(0.5)
})

it('keeps all at the same fraction of their length', () => {
  const period = periodOf('step', [1, 3])
  expect(period).toBe(2)
  expect([1, 3].map((length) => timeIn('step', 1, length, period) / length)).toEqual([0.5, 0.5])
  expect(timeIn('step', 2.5, 1, period)).toBeCloseTo(0.25)
})

it('stays at zero if there is nothing', () => {
  expect(timeIn('own', 3, 0, 1)).toBe(0)
  expect(periodOf('together', [])).toBe(1)
})
