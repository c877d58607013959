import { expect, it } from 'vitest'
import { kPhaseKeys, phaseActionOf } from './keys'

const key = (name: string, more: { shiftKey?: boolean; ctrlKey?: boolean; altKey?: boolean } = {}) => ({
  key: name,
  shiftKey: false,
  ctrlKey: false,
  altKey: false,
  metaKey: false,
  ...more,
})

it('has a key for every action, and one action per key', () => {
  const keys = kPhaseKeys.flatMap(({ keys: some }) => some as readonly string[])
  expect(new Set(keys).size).toBe(keys.length)
  for (const { keys: some, actions } of kPhaseKeys) {
    expect(some.length).toBe(actions.length)
  }
})

it('recognizes letters in both cases, and with Shift and Ctrl', () => {
  expect(
    [key('q'), key('Q', { shiftKey: true }), key('Enter'), key('Enter', { shiftKey: true }), key('Backspace'), key('ArrowDown', { shiftKey: true })].map(
      (event) => phaseActionOf(event),
    ),
  ).toEqual(['beginBack', 'beginFarBack', 'accept', 'acceptAll', 'reject', 'next'])
  expect(
    [
      key('z', { ctrlKey: true }),
      key('Z', { ctrlKey: true, shiftKey: true }),
      key('y', { ctrlKey: true }),
      key('x', { ctrlKey: true }),
      key('b', { altKey: true }),
      key('j'),
    ].map((event) => phaseActionOf(event)),
  ).toEqual(['undo', 'redo', 'redo', undefined, undefined, undefined])
})

it('ignores letters if they are not shortcuts', () => {
  expect([key('q'), key('Enter'), key('ArrowUp'), key('z', { ctrlKey: true })].map((event) => phaseActionOf(event, false))).toEqual([
    undefined,
    'accept',
    'before',
    'undo',
  ])
})
