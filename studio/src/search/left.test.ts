import { expect, it } from 'vitest'
import type { Answer } from './answers'
import { chosenAgain, comeBack, leave } from './left'

const answer = (at: number, name: string): Answer => ({ at, recording: 'r', tier: 'Gloss', name, begin: 100 * at, end: 100 * at + 50 })

it('returns once how a search was left, only for its address', () => {
  leave({ hash: '#/a', chosen: [], focused: true })
  expect(comeBack('#/b')).toBeUndefined()
  expect(comeBack('#/a')?.focused).toBe(true)
  expect(comeBack('#/a')).toBeUndefined()
})

it('selects again what still exists, in the order of selection', () => {
  const answers = [answer(0, 'A'), answer(1, 'B'), answer(2, 'C')]
  expect([...chosenAgain([answers[2], answer(1, 'X'), answers[0], answer(7, 'D')], answers)]).toEqual([2, 0])
})
