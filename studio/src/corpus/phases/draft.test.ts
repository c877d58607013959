import { expect, it } from 'vitest'
import { dropDraft, isKeyOf, isOf, keepDraft, keptDraft, revisionOf } from './draft'
import { kEmpty, put } from './review'

function storage(): Storage {
  const kept = new Map<string, string>()
  return {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => void kept.set(key, value),
    removeItem: (key: string) => void kept.delete(key),
  } as unknown as Storage
}
const frames = { originMs: 0, rate: 100, count: 10 }
const review = put(kEmpty, { hand: 'right', kind: 'stroke', begin: 0, end: 50, state: 'accepted' })

it('stores a review for its recording until it is dropped', () => {
  const here = storage()
  const done = keepDraft('a/b', 'c', { frames, review }, undefined, here)
  expect(done).toEqual({ revision: revisionOf('a/b', 'c', here) })
  expect(keptDraft('a/b', 'c', here)).toEqual({ frames, review })
  expect(keptDraft('a', 'b/c', here)).toBeUndefined()
  dropDraft('a/b', 'c', revisionOf('a/b', 'c', here), here)
  expect(keptDraft('a/b', 'c', here)).toBeUndefined()
})

it('ignores broken drafts, and reports if nothing can be stored', () => {
  const here = storage()
  for (const text of [
    '',
    '{',
    '{"version":1}',
    JSON.stringify({ version: 1, frames, review: { ...review, next: 1 } }),
    JSON.stringify({ version: 0, frames, review }),
  ]) {
    here.setItem('signweave.review.a/b', text)
    expect(keptDraft('a', 'b', here)).toBeUndefined()
  }
  const full = {
    setItem: () => {
      throw new Error('full')
    },
  } as unknown as Storage
  expect(keepDraft('a', 'b', { frames, review }, undefined, full)).toBe('full')
  expect(isOf({ frames, review }, { ...frames, rate: 50 })).toBe(false)
})

it('never overwrites what another window has stored meanwhile', () => {
  const here = storage(),
    other = put(review, { hand: 'left', kind: 'hold', begin: 0, end: 50, state: 'open' })
  const keep = (one: typeof review, seen: string | undefined) => keepDraft('a', 'b', { frames, review: one }, seen, here)
  const first = keep(review, undefined) as { revision: string }
  // Two windows have read it; one of them continues.
  const second = keep(other, first.revision) as { revision: string }
  expect(keep(review, first.revision)).toBe('changed')
  expect(keptDraft('a', 'b', here)!.review).toEqual(other)
  dropDraft('a', 'b', first.revision, here)
  expect(keptDraft('a', 'b', here)).toBeDefined()
  dropDraft('a', 'b', second.revision, here)
  expect(keptDraft('a', 'b', here)).toBeUndefined()
  expect(keep(review, second.revision)).toBe('changed')
  // A draft stored by an older studio has a revision, too.
  here.setItem('signweave.review.a/b', JSON.stringify({ version: 1, frames, review }))
  expect(keep(other, undefined)).toBe('changed')
  expect(keep(other, revisionOf('a', 'b', here))).toHaveProperty('revision')
  expect([isKeyOf('signweave.review.a/b', 'a', 'b'), isKeyOf('signweave.review.a/c', 'a', 'b'), isKeyOf(null, 'a', 'b')]).toEqual([true, false, true])
})
