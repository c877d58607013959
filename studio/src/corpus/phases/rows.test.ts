import { expect, it } from 'vitest'
import { bordersOf, edgeNear, phaseAt, rowsOf } from './rows'
import { kEmpty, put } from './review'

const phase = (hand: 'right' | 'left', begin: number, end: number) => ({ hand, kind: 'stroke', begin, end, state: 'open' as const })
const review = [phase('right', 0, 1000), phase('right', 1000, 2000), phase('left', 500, 1500)].reduce(put, kEmpty)

it('shows a row for each hand above the annotation', () => {
  const { tiers } = rowsOf(review, 2, { tiers: [{ name: 'Gloss', depth: 0, annotations: [] }] }, { right: 'Right', left: 'Left' }, { stroke: 'Stroke' })
  expect(tiers.map(({ name }) => name)).toEqual(['Right', 'Left', 'Gloss'])
  expect(tiers[0].annotations[1]).toEqual({ begin: 1000, end: 2000, label: 'Stroke', state: 'open', current: true })
  expect([phaseAt(review, 1, 0)?.id, phaseAt(review, 2, 0)]).toEqual([3, undefined])
})

it("finds the border under the pointer; if two touch, that of the pointer's side or of the current phase", () => {
  expect(edgeNear(review, 0, 1010, 20)).toEqual({ id: 2, edge: 'begin' })
  expect(edgeNear(review, 0, 990, 20)).toEqual({ id: 1, edge: 'end' })
  expect(edgeNear(review, 0, 1010, 20, 1)).toEqual({ id: 1, edge: 'end' })
  expect([edgeNear(review, 0, 1100, 20), edgeNear(review, 2, 0, 20), edgeNear(review, 1, 1500, 0)?.edge]).toEqual([undefined, undefined, 'end'])
})

it('moves the grabbed border until it is released', () => {
  const calls: unknown[] = []
  const borders = bordersOf(
    () => review,
    () => undefined,
    (...move) => calls.push(move),
    () => calls.push('done'),
  )
  expect([borders.isNear(1, 490, 20), borders.grab(1, 490, 20), borders.grab(1, 900, 20)]).toEqual([true, true, false])
  borders.drag(480)
  borders.grab(1, 490, 20)
  borders.drag(470)
  borders.drop()
  borders.drag(460)
  expect(calls).toEqual([[3, 'begin', 470], 'done'])
})
