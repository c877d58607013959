// @vitest-environment jsdom
import { beforeEach, expect, it, vi } from 'vitest'
import type { Api } from '../../api/client'
import { keptDraft } from './draft'
import { PhasesSession } from './phases_session.svelte'
import { acceptedAll, decided } from './review'

/** The server's content. */
let eaf: string, frames: number, print: string
const api = {
  json: (where: string) =>
    Promise.resolve(
      where.endsWith('/segment')
        ? {
            hands: {
              right: [
                { phase: 'stroke', begin_ms: 0, end_ms: 500, confidence: 1 },
                { phase: 'hold', begin_ms: 500, end_ms: 700, confidence: 1 },
              ],
              left: [],
            },
          }
        : { motion_file: 'r.bvh', annotation_file: 'r.eaf', annotation_fingerprint: print, frames, frames_per_second: 100, clock_origin_ms: 0 },
    ),
  annotation: () => Promise.resolve(eaf),
} as unknown as Api
const kNone = '<ANNOTATION_DOCUMENT AUTHOR=""><HEADER/><TIME_ORDER/></ANNOTATION_DOCUMENT>'
/** The same with phases that someone else checked. */
const kTheirs = `<ANNOTATION_DOCUMENT AUTHOR="B"><HEADER/><TIME_ORDER>
<TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="100"/><TIME_SLOT TIME_SLOT_ID="ts2" TIME_VALUE="200"/></TIME_ORDER>
<TIER TIER_ID="Phase RH (checked)" LINGUISTIC_TYPE_REF="checked phase"><ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1"
TIME_SLOT_REF2="ts2"><ANNOTATION_VALUE>retraction</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER></ANNOTATION_DOCUMENT>`
const opened = async () => {
  const session = new PhasesSession(api, 'd', 'r')
  await vi.waitFor(() => expect(session.status).toBe('open'))
  return session
}
beforeEach(() => {
  localStorage.clear()
  ;[eaf, frames, print] = [kNone, 100, '1']
})

it('detects a changed annotation or motion, and whose phases are preserved', async () => {
  const session = await opened()
  expect(await session.renew()).toBe('same')
  eaf = eaf.replace('AUTHOR=""', 'AUTHOR="B"')
  expect([await session.renew(), session.conflicting, session.annotation.tiers.length]).toEqual(['annotation', [], 0])
  eaf = kTheirs
  expect([await session.renew(), session.conflicting, await session.renew(), session.conflicting]).toEqual(['annotation', ['right'], 'same', ['right']])
  // An annotation stored between the requests for the recording and for its annotation.
  print = '2'
  expect([await session.renew(), await session.renew()]).toEqual(['annotation', 'same'])
  // What was stored after that is this review's own.
  await session.stored()
  expect(session.conflicting).toEqual([])
  frames = 90
  expect(await session.renew()).toBe('motion')
  session.close()
})

it('detects for a continued review whether phases were stored since', async () => {
  const first = await opened()
  first.apply(acceptedAll(first.review))
  first.close()
  eaf = kTheirs
  const then = await opened()
  expect([then.from, then.conflicting]).toEqual(['draft', ['right']])
  await then.discard()
  expect([then.from, then.conflicting]).toEqual(['stored', []])
  then.close()
})

it("overwrites no other window's draft until the user chooses", async () => {
  const one = await opened(),
    two = await opened(),
    stored = () => keptDraft('d', 'r')?.review
  one.apply(decided(one.review, 1, 'accepted'))
  const theirs = one.review
  two.apply(decided(two.review, 2, 'rejected'))
  const mine = two.review
  expect([two.elsewhere?.draft?.review, stored()]).toEqual([theirs, theirs])
  two.takeElsewhere()
  expect([two.review, two.elsewhere]).toEqual([theirs, undefined])
  two.undo()
  expect(stored()).toEqual(mine)
  one.undo()
  expect([one.elsewhere !== undefined, stored()]).toEqual([true, mine])
  one.keepMine()
  expect(stored()).toEqual(one.review)
  // The other window is notified, also while it is idle.
  dispatchEvent(new StorageEvent('storage', { key: 'signweave.review.d/r' }))
  expect([one.elsewhere, two.elsewhere?.draft?.review]).toEqual([undefined, one.review])
  one.close()
  two.close()
})
