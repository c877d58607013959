import { expect, it, vi } from 'vitest'
import type { Api } from '../../api/client'
import * as calls from '../../api/corpus_calls'
import type { InspectedRecording, TierRow } from '../../api/schema'
import { inspectedAnswer } from '../../api/test_answers'
import type { HandName } from '../../api/types'
import { choicesOf, filesFor, isDefault, sendReview } from './store_review'

const tier = (name: string, role: TierRow['role'], hand: HandName = 'both'): TierRow => ({
  tier: name,
  parent: null,
  annotations: 1,
  labels: 1,
  role,
  hand,
})
const report = (...tiers: TierRow[]) => inspectedAnswer({ name: 'a', files: { motion: null, annotation: 'a.eaf', face: null }, known: true, tiers })
const kWritten = [
  { hand: 'right' as const, name: 'RH', count: 3, unseen: 0 },
  { hand: 'left' as const, name: 'LH', count: 5, unseen: 0 },
]
const kinds = (one: InspectedRecording) => choicesOf(one, kWritten).map(({ kind }) => kind)

it("keeps the source of the signs' phases if it is another tier", () => {
  const one = report(tier('Gloss', 'signs'), tier('Phase', 'phases'), tier('RH', 'phases'))
  expect(choicesOf(one, kWritten)[0]).toEqual({ kind: 'now', tiers: ['Phase'] })
  expect([isDefault(one, { kind: 'now', tiers: ['Phase'] }), isDefault(one, { kind: 'both', tiers: ['RH', 'Phase'] })]).toEqual([false, true])
})

it('takes the hand used before, otherwise the one with more phases', () => {
  expect(kinds(report(tier('Gloss', 'signs'), tier('RH', 'phases')))).toEqual(['right', 'left', 'both'])
  expect(kinds(report(tier('Gloss', 'signs')))).toEqual(['left', 'right', 'both'])
})

it('takes both hands if each has its own signs, and offers no choice without signs', () => {
  expect(kinds(report(tier('Gloss R', 'signs', 'right'), tier('Gloss L', 'signs', 'left')))).toEqual(['both', 'left', 'right'])
  expect(kinds(report(tier('Note', '')))).toEqual([])
})

it('discards its upload if it is aborted or fails', async () => {
  vi.spyOn(calls, 'openUpload').mockResolvedValue('u')
  const send = vi.spyOn(calls, 'sendFile').mockRejectedValueOnce(new Error('no'))
  const discarded = vi.spyOn(calls, 'discardUpload').mockResolvedValue()
  const cancelled = vi.spyOn(calls, 'cancelJob').mockResolvedValue()
  vi.spyOn(calls, 'beginUpload').mockResolvedValue({ job: 'j' })
  const steps: string[] = []
  const api = { result: () => (steps.push('ended'), Promise.reject(new Error('aborted'))) } as unknown as Api
  discarded.mockImplementation(() => (steps.push('discarded'), Promise.resolve()))
  await expect(sendReview(api, 'd', 'r', new Blob(), new AbortController().signal)).rejects.toThrow('no')
  expect([discarded.mock.calls.length, cancelled.mock.calls.length]).toEqual([1, 0])
  send.mockResolvedValue()
  await expect(sendReview(api, 'd', 'r', new Blob(), new AbortController().signal)).rejects.toThrow('aborted')
  expect([discarded.mock.calls.length, cancelled.mock.calls.length, discarded.mock.lastCall?.[2]]).toEqual([2, 1, 'u'])
  // Not before the job is over, because the server refuses that.
  expect(steps).toEqual(['discarded', 'ended', 'ended', 'discarded'])
  vi.restoreAllMocks()
})

it('sends the document of a recording whose name is no valid file name under another name, with a table that gives it', () => {
  expect(filesFor('walk')).toEqual({ file: 'walk.eaf' })
  expect(filesFor('day 1/walk').file).toBe('walk.eaf')
  expect(filesFor('day 1/walk, "far"').table).toMatch(/^motion,.*,name\n,"walk, ""far"".eaf",,,,,"day 1\/walk, ""far"""\n$/)
  expect([filesFor('a:b').file, filesFor('.a').file, filesFor('a/').file]).toEqual(['review.eaf', 'review.eaf', 'review.eaf'])
})
