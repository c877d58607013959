import { expect, it } from 'vitest'
import { dropDraft, isOf, keepDraft, keptDraft } from './draft'
import { kEmpty, put } from './review'

function storage(): Storage {
  const kept = new Map<string, string>()
  return { getItem: (key: string) => kept.get(key) ?? null, setItem: (key: string, value: string) => void kept.set(key, value),
    removeItem: (key: string) => void kept.delete(key) } as unknown as Storage
}
const frames = { originMs: 0, rate: 100, count: 10 }
const review = put(kEmpty, { hand: 'right', kind: 'stroke', begin: 0, end: 50, state: 'accepted' })

it('keeps a review for its recording until it is dropped', () => {
  const here = storage()
  expect(keepDraft('a/b', 'c', { frames, review }, here)).toBe(true)
  expect(keptDraft('a/b', 'c', here)).toEqual({ frames, review })
  expect(keptDraft('a', 'b/c', here)).toBeUndefined()
  dropDraft('a/b', 'c', here)
  expect(keptDraft('a/b', 'c', here)).toBeUndefined()
})

it('takes nothing that is broken, and says where nothing can be kept', () => {
  const here = storage()
  for (const text of ['', '{', '{"version":1}', JSON.stringify({ version: 1, frames, review: { ...review, next: 1 } }),
    JSON.stringify({ version: 0, frames, review })]) {
    here.setItem('signweave.review.a/b', text)
    expect(keptDraft('a', 'b', here)).toBeUndefined()
  }
  const full = { setItem: () => { throw new Error('full') } } as unknown as Storage
  expect(keepDraft('a', 'b', { frames, review }, full)).toBe(false)
  expect(isOf({ frames, review }, { ...frames, rate: 50 })).toBe(false)
})
