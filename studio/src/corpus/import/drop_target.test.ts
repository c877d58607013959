import { describe, expect, it } from 'vitest'
import type { DatabaseRow } from '../../api/schema'
import { dropTarget } from './drop_target'

const row = (name: string, writable: boolean, placeholder = false): DatabaseRow => ({
  name,
  writable,
  recordings: 1,
  declarations: placeholder ? { 'signweave:placeholder': 'no signs' } : {},
})

describe('dropped files', () => {
  it('are imported into the database of the page', () => {
    expect(dropTarget(false, [row('a', true), row('b', true)], 'b')).toEqual({ database: 'b' })
  })
  it('are imported, if no database is selected, into one that is not a demo if possible', () => {
    expect(dropTarget(false, [row('demo', true, true), row('read', false), row('mine', true)], undefined)).toEqual({ database: 'mine' })
    expect(dropTarget(false, [row('read', false), row('demo', true, true)], undefined)).toEqual({ database: 'demo' })
  })
  it('are rejected with a reason if nothing can be stored', () => {
    expect(dropTarget(true, [row('a', true)], 'a')).toEqual({ why: 'locked' })
    expect(dropTarget(false, undefined, 'a')).toEqual({ why: 'unknown' })
    expect(dropTarget(false, [], undefined)).toEqual({ why: 'noDatabase' })
    expect(dropTarget(false, [row('a', true)], 'gone')).toEqual({ why: 'noDatabase' })
    expect(dropTarget(false, [row('a', false), row('b', true)], 'a')).toEqual({ why: 'readOnly', database: 'a' })
    expect(dropTarget(false, [row('a', false)], undefined)).toEqual({ why: 'allReadOnly' })
  })
})
