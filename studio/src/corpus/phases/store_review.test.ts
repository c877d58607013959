import { expect, it } from 'vitest'
import type { HandName, Inspected, TierReport } from '../../api/corpus_answers'
import { choicesOf, filesFor, isTold } from './store_review'

const tier = (name: string, role: TierReport['role'], hand: HandName = 'both'): TierReport => ({ tier: name, parent: null, annotations: 1, labels: 1, role,
  hand })
const report = (...tiers: TierReport[]): Inspected => ({ name: 'a', files: { motion: null, annotation: 'a.eaf', face: null }, known: true, tiers })
const kWritten = [{ hand: 'right' as const, name: 'RH', count: 3 }, { hand: 'left' as const, name: 'LH', count: 5 }]
const kinds = (one: Inspected) => choicesOf(one, kWritten).map(({ kind }) => kind)

it('leaves the phases of signs where they come from, where that is another tier', () => {
  const one = report(tier('Gloss', 'signs'), tier('Phase', 'phases'), tier('RH', 'phases'))
  expect(choicesOf(one, kWritten)[0]).toEqual({ kind: 'now', tiers: ['Phase'] })
  expect([isTold(one, { kind: 'now', tiers: ['Phase'] }), isTold(one, { kind: 'both', tiers: ['RH', 'Phase'] })]).toEqual([false, true])
})

it('takes the hand that was taken before, else the one that does more', () => {
  expect(kinds(report(tier('Gloss', 'signs'), tier('RH', 'phases')))).toEqual(['right', 'left', 'both'])
  expect(kinds(report(tier('Gloss', 'signs')))).toEqual(['left', 'right', 'both'])
})

it('takes both hands where each has signs of its own, and asks nothing where there are none', () => {
  expect(kinds(report(tier('Gloss R', 'signs', 'right'), tier('Gloss L', 'signs', 'left')))).toEqual(['both', 'left', 'right'])
  expect(kinds(report(tier('Note', '')))).toEqual([])
})

it('sends the document of a recording whose name no file can have under another, with a table that tells it', () => {
  expect(filesFor('walk')).toEqual({ file: 'walk.eaf' })
  expect(filesFor('day 1/walk').file).toBe('walk.eaf')
  expect(filesFor('day 1/walk, "far"').table).toMatch(/^motion,.*,name\n,"walk, ""far"".eaf",,,,,"day 1\/walk, ""far"""\n$/)
  expect([filesFor('a:b').file, filesFor('.a').file, filesFor('a/').file]).toEqual(['review.eaf', 'review.eaf', 'review.eaf'])
})
