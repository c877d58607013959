import { describe, expect, it } from 'vitest'
import { apart, scaleOf } from './scale'

describe('a scale', () => {
  it('extends from zero to beyond the highest value in round steps', () => {
    const { at, ticks, digits } = scaleOf([3, 27, 140], 300, false)
    expect(ticks).toEqual([0, 50, 100, 150])
    expect([at(0), at(75), at(150), digits]).toEqual([0, 150, 300, 0])
  })
  it('has room below zero', () => {
    const { at, ticks, digits } = scaleOf([-0.3, 0.11], 100, false)
    expect(ticks[0]).toBeLessThanOrEqual(-0.3)
    expect(at(0)).toBeGreaterThan(0)
    expect(digits).toBe(1)
  })
  it('is logarithmic on request if all values are positive', () => {
    const { at, ticks } = scaleOf([2, 200], 100, true)
    expect(ticks).toEqual([2, 5, 10, 20, 50, 100, 200])
    expect(at(20)).toBeCloseTo(50)
    expect(scaleOf([0, 2], 100, true).ticks[0]).toBe(0)
  })
  it('exists even if all values are equal or there are none', () => {
    expect(scaleOf([0, 0], 100, false).at(0)).toBe(0)
    expect(scaleOf([], 100, false).ticks).toEqual([])
    expect(scaleOf([5, 5], 100, true).at(5)).toBeCloseTo(47.5, 1)
  })
})

describe('labels', () => {
  it('are moved apart, and stay inside', () => {
    expect(apart([10, 11, 12], 14, 0, 100)).toEqual([10, 24, 38])
    expect(apart([90, 95, 99], 14, 0, 100)).toEqual([72, 86, 100])
  })
})
