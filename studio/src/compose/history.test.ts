import { expect, it } from 'vitest'
import { begun, did, redone, undone, type History } from './history'

const many = (history: History<number>, step: (one: History<number>) => History<number>, times: number) => {
  for (let i = 0; i < times; ++i) history = step(history)
  return history.now
}

it('undoes and redoes steps', () => {
  const history = did(did(begun(1), 2), 3)
  expect([many(history, undone, 1), many(history, undone, 2), many(history, undone, 9), redone(undone(history)).now, many(history, redone, 2)]).toEqual([
    2, 1, 1, 3, 3,
  ])
})

it('forgets undone steps after a new change', () => {
  const history = did(undone(did(did(begun(1), 2), 3)), 4)
  expect([redone(history).now, undone(history).now]).toEqual([4, 2])
})

it('undoes quick changes of one subject together', () => {
  const typed = did(did(did(begun(1), 2, 'text', 0), 3, 'text', 1000), 4, 'text', 2000)
  expect(undone(typed).now).toBe(1)
  expect(undone(did(typed, 5, 'text', 9000)).now).toBe(4)
  expect(undone(did(typed, 5, 'tempo', 2100)).now).toBe(4)
  expect(undone(did(typed, 5)).now).toBe(4)
  expect(undone(did(redone(undone(typed)), 5, 'text', 2001)).now).toBe(4)
  expect(did(typed, 4)).toBe(typed)
})

it('stores at most five hundred steps', () => {
  let history = begun(0)
  for (let i = 1; i <= 700; ++i) history = did(history, i)
  expect(many(history, undone, 700)).toBe(200)
})
