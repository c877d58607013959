import { expect, it } from 'vitest'
import type { Answer } from './answers'
import { filtered, kFound, nextOrder, ordered, orderOf, orderText, type SortKey } from './order'

const answer = (at: number, name: string, begin: number, end: number, more: Partial<Answer> = {}): Answer => ({
  at,
  recording: 'meteo',
  tier: 'Gloss',
  name,
  begin,
  end,
  ...more,
})
const list = [
  answer(0, 'été', 500, 900, { distance: 0.5 }),
  answer(1, 'b10', 100, 900, { distance: 0.2 }),
  answer(2, 'b9', 300, 400),
  answer(3, 'été', 0, 50, { recording: 'villes', bindings: ['x'] }),
]
const at = (by: SortKey, down = false) => ordered(list, { by, down }, 'fr').map((one) => one.at)

it('sorts by every column in both directions, and keeps the order of equal ones', () => {
  expect(at('name')).toEqual([2, 1, 0, 3])
  expect(at('name', true)).toEqual([0, 3, 1, 2])
  expect(at('recording', true)).toEqual([3, 0, 1, 2])
  expect(at('tier')).toEqual([0, 1, 2, 3])
  expect(at('begin')).toEqual([3, 1, 2, 0])
  expect(at('end')).toEqual([3, 2, 0, 1])
  expect(at('duration')).toEqual([3, 2, 0, 1])
  expect(at('distance').slice(0, 2)).toEqual([1, 0])
  expect(at('$0')).toEqual([0, 1, 2, 3])
  expect(at('found')).toEqual([0, 1, 2, 3])
})

it('cycles through ascending, descending and as found', () => {
  const up = nextOrder(kFound, 'name')
  expect(up).toEqual({ by: 'name', down: false })
  expect(nextOrder(up, 'name')).toEqual({ by: 'name', down: true })
  expect(nextOrder(nextOrder(up, 'name'), 'name')).toEqual(kFound)
  expect(nextOrder(up, 'begin')).toEqual({ by: 'begin', down: false })
})

it('keeps answers that contain every typed word', () => {
  expect(filtered(list, ' ÉTÉ  vil ').map((one) => one.at)).toEqual([3])
  expect(filtered(list, '')).toBe(list)
})

it('sorts names word by word, with numbers by value', () => {
  const names = ['VANNES MATIN', 'VANNES', 'ÉTÉ 10', 'ÉTÉ 9', 'VANNES BREST']
  expect(
    ordered(
      names.map((name, i) => answer(i, name, 0, 1)),
      { by: 'name', down: false },
      'fr',
    ).map(({ name }) => name),
  ).toEqual(['ÉTÉ 9', 'ÉTÉ 10', 'VANNES', 'VANNES BREST', 'VANNES MATIN'])
})

it('writes the order to the address', () => {
  for (const order of [
    { by: 'name', down: true },
    { by: '$1', down: false },
  ] as const)
    expect(orderOf(orderText(order))).toEqual(order)
  for (const text of ['', 'x', '--name', undefined]) expect(orderOf(text)).toBe(kFound)
})
