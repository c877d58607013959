import { expect, it } from 'vitest'
import { Shared } from './shared'

it('creates a resource once, and disposes it when the last user has left', () => {
  const shared = new Shared<{ dispose(): void }>()
  let made = 0,
    gone = 0
  const make = () => (++made, { dispose: () => void ++gone })
  const first = shared.take('a', make)
  expect(shared.take('a', make)).toBe(first)
  expect(shared.take('b', make)).not.toBe(first)
  shared.leave('a')
  expect([made, gone]).toEqual([2, 0])
  shared.leave('a')
  shared.leave('a')
  expect(gone).toBe(1)
  expect(shared.take('a', make)).not.toBe(first)
})
