import { expect, it } from 'vitest'
import { kGap, layoutOf, moved, shownCells } from './cells'

it('puts as many cells side by side as fit', () => {
  const small = layoutOf(1240, 'small'),
    large = layoutOf(1240, 'large'),
    phone = layoutOf(344, 'medium')
  expect([small.columns, large.columns, phone.columns]).toEqual([8, 4, 2])
  for (const { columns, width } of [small, large]) expect(columns * width + (columns - 1) * kGap).toBeLessThanOrEqual(1240)
  expect(layoutOf(20, 'large').columns).toBe(1)
})

it('creates the visible cells, and one more row on each side', () => {
  const layout = { columns: 5, width: 100, picture: 96, step: 100 }
  expect(shownCells(1000, layout, 1000, 250)).toEqual({ first: 45, end: 70, row: 9, top: 900 })
  expect(shownCells(7, layout, 0, 250)).toEqual({ first: 0, end: 7, row: 0, top: 0 })
})

it('moves by keys, and stays at the borders', () => {
  expect(moved('ArrowRight', 3, 10, 4, 2)).toBe(4)
  expect(moved('ArrowDown', 3, 10, 4, 2)).toBe(7)
  expect(moved('ArrowDown', 7, 10, 4, 2)).toBe(7)
  expect(moved('ArrowUp', 2, 10, 4, 2)).toBe(2)
  expect(moved('ArrowLeft', 0, 10, 4, 2)).toBe(0)
  expect(moved('End', 0, 10, 4, 2)).toBe(9)
  expect(moved('PageDown', 0, 100, 4, 2)).toBe(8)
  expect(moved('q', 5, 10, 4, 2)).toBe(5)
})
