import { expect, it } from 'vitest'
import { heightOfRows, kMostPixels, scrollTo, shownRows } from './rows'

it('draws the visible rows and a few more, at their positions', () => {
  expect(shownRows(100, 20, 200, 100, 0)).toEqual({ first: 10, end: 15, top: 200 })
  expect(shownRows(3, 20, 0, 100)).toEqual({ first: 0, end: 3, top: 0 })
  expect(shownRows(0, 20, 0, 100)).toEqual({ first: 0, end: 0, top: 0 })
})

it("reaches every row of lists higher than the browser's limit", () => {
  const count = 2_000_000
  expect(heightOfRows(count, 30)).toBe(kMostPixels)
  const last = shownRows(count, 30, kMostPixels - 600, 600, 0)
  expect(last.end).toBe(count)
  expect(last.top + 30 * (last.end - last.first)).toBeCloseTo(kMostPixels, 3)
  expect(shownRows(count, 30, 0, 600, 0)).toEqual({ first: 0, end: 20, top: 0 })
})

it('scrolls to a row, and does not move if it is visible', () => {
  for (const count of [1000, 2_000_000]) {
    for (const row of [0, 1, 17, 500, count - 1]) {
      const scroll = scrollTo(row, count, 30, 0, 600)
      const { first, end } = shownRows(count, 30, scroll, 600, 0)
      expect(first <= row && row < end).toBe(true)
      expect(scrollTo(row, count, 30, scroll, 600)).toBeCloseTo(scroll, 6)
    }
  }
})
