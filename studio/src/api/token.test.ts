import { expect, it } from 'vitest'
import { keepToken, keptToken, tokenIn } from './token'

const store = () => {
  const all = new Map<string, string>()
  return {
    getItem: (key: string) => all.get(key) ?? null,
    setItem: (key: string, value: string) => void all.set(key, value),
    removeItem: (key: string) => void all.delete(key),
  }
}

it('stores a token, and forgets it', () => {
  const kept = store()
  expect(keptToken(kept)).toBe('')
  keepToken('secret', kept)
  expect(keptToken(kept)).toBe('secret')
  keepToken('', kept)
  expect(keptToken(kept)).toBe('')
})

it('works in a browser that stores nothing', () => {
  const none = () => {
    throw new Error('SecurityError')
  }
  const closed = { getItem: none, setItem: none, removeItem: none }
  expect(keptToken(closed)).toBe('')
  expect(() => keepToken('secret', closed)).not.toThrow()
})

it('removes the token from an address', () => {
  expect(tokenIn('https://x.org/studio/?token=S%2B1&a=b#/demo')).toEqual({ token: 'S+1', rest: 'https://x.org/studio/?a=b#/demo' })
  expect(tokenIn('https://x.org/studio/#/demo')).toEqual({ token: undefined, rest: 'https://x.org/studio/#/demo' })
})
