import { expect, it } from 'vitest'
import { TimeWindow, tickStep } from './window'

it('keeps the moment under the pointer in place when zooming', () => {
  const shown = new TimeWindow(100, 1000)
  shown.zoom(4, 30)
  expect(shown.x(30)).toBeCloseTo(300)
  expect(shown.span).toBeCloseTo(25)
  shown.zoom(0.001, 30)
  expect([shown.begin, shown.end]).toEqual([0, 100])
})

it('stays inside the motion, and pages when the current time leaves it', () => {
  const shown = new TimeWindow(100, 1000)
  shown.zoom(10, 0)
  shown.move(500)
  expect(shown.end).toBeCloseTo(100)
  expect(shown.follow(95)).toBe(false)
  expect(shown.follow(20)).toBe(true)
  expect(shown.begin).toBeCloseTo(19.5)
})

it('places ticks at 1, 2 and 5', () => {
  expect([0.03, 0.2, 0.21, 3, 7].map(tickStep)).toEqual([0.05, 0.2, 0.5, 5, 10].map((step) => expect.closeTo(step)))
})
