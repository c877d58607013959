import { expect, it } from 'vitest'
import type { Answer } from './answers'
import { chosenOf, toggled, withRange } from './choice'

const answers = [0, 1, 2, 3, 4].map((at): Answer => ({ at, recording: 'r', tier: 't', name: `n${at}`, begin: at, end: at + 1 }))
const list = answers.toReversed()

it('selects one, and deselects it', () => {
  expect([...toggled(new Set([1]), 3)]).toEqual([1, 3])
  expect([...toggled(new Set([1, 3]), 1)]).toEqual([3])
})

it("selects from one row to another, in the list's order", () => {
  expect([...withRange(new Set([2]), list, 0, 3)]).toEqual([2, 4, 3, 1])
  expect([...withRange(new Set(), list, 3, 2)]).toEqual([1, 2])
})

it('returns the selected answers in the order of selection', () => {
  expect(chosenOf(new Set([3, 0, 99]), answers).map(({ name }) => name)).toEqual(['n3', 'n0'])
})
