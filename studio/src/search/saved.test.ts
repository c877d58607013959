import { expect, it } from 'vitest'
import { asked, keep, kNothingKept, merged, readFile, readKept, remove, rename, restore, writeFile } from './saved'

const one = { name: 'tokens', text: 'gloss = "VANNES"' },
  two = { name: 'strokes', text: 'phase = stroke' }
const both = { saved: [one, two], recent: [] }

it('saves a query under a name, and replaces it', () => {
  expect(keep(kNothingKept, one.name, one.text).saved).toEqual([one])
  expect(keep(both, 'tokens', 'unit').saved).toEqual([{ name: 'tokens', text: 'unit' }, two])
})

it('renames, and keeps names unique', () => {
  expect(rename(both, 'tokens', ' x ').saved[0].name).toBe('x')
  expect(rename(both, 'tokens', 'strokes').saved[0].name).toBe('strokes (2)')
  expect(rename(both, 'tokens', '  ')).toBe(both)
  expect(rename(both, 'nobody', 'x')).toBe(both)
})

it('restores a removed query at its position', () => {
  const without = remove(both, 'tokens')
  expect(without.saved).toEqual([two])
  expect(restore(without, one, 0)).toEqual(both)
  const replaced = keep(both, 'tokens', 'unit')
  expect(restore(replaced, one, 0, true)).toEqual(both)
  expect(restore(without, one, 0, true)).toEqual(both)
})

it('remembers recent queries, each once', () => {
  let kept = kNothingKept
  for (const text of ['a', 'b', ' a ', '']) kept = asked(kept, text)
  expect(kept.recent).toEqual(['a', 'b'])
  for (let i = 0; i < 50; ++i) kept = asked(kept, `q${i}`)
  expect(kept.recent).toHaveLength(20)
})

it('reads what it wrote to a file, and adds it', () => {
  expect(readFile(writeFile([one, two]))).toEqual([one, two])
  expect(merged({ saved: [one], recent: [] }, [one, { name: 'tokens', text: 'other' }, two]).saved.map(({ name }) => name)).toEqual([
    'tokens',
    'tokens (2)',
    'strokes',
  ])
  for (const wrong of ['', '{}', '[]', '{"signweave queries":1,"queries":[{"name":""}]}', '{"queries":[]}', 'null'])
    expect(readFile(wrong), wrong).toBeUndefined()
})

it('reads any stored text', () => {
  expect(readKept(JSON.stringify({ saved: [one, 3, { name: 'x' }], recent: ['a', 1] }))).toEqual({ saved: [one], recent: ['a'] })
  for (const wrong of [null, undefined, '', 'null', '3', '{', '{"saved":3}']) expect(readKept(wrong)).toEqual(kNothingKept)
})
