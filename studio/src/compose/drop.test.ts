import { expect, it } from 'vitest'
import { dropAt, scrollAt } from './drop'

it('finds the insertion point of a dropped card, line by line', () => {
  const box = (left: number, top: number) => ({ left, right: left + 80, top, bottom: top + 40 })
  const boxes = [box(0, 0), box(100, 0), box(200, 0), box(0, 50), box(100, 50)]
  const at = (x: number, y: number) => dropAt(boxes, x, y)
  expect([at(-5, 20), at(30, 20), at(60, 20), at(150, 20), at(500, 20)]).toEqual([0, 0, 1, 2, 3])
  expect([at(10, 70), at(90, 70), at(500, 70), at(10, 45), at(5, -20), at(5, 500)]).toEqual([3, 4, 5, 3, 0, 5])
})

it('scrolls a list when something is dragged to its border', () => {
  expect([-50, 5, 50, 95, 300].map((y) => scrollAt({ top: 0, bottom: 100 }, y))).toEqual([-10, -10, 0, 10, 10])
})
