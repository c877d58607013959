// @vitest-environment jsdom
import { beforeEach, expect, it, vi } from 'vitest'
import type { Api } from '../../api/client'
import { emptyEaf, writeChecked } from './checked_tiers'
import { keptDraft } from './draft'
import { PhasesSession } from './phases_session.svelte'
import { acceptedAll, decided, kEmpty, put } from './review'

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
  call: () => Promise.resolve({ arrayBuffer: () => Promise.resolve(new TextEncoder().encode(eaf).buffer) }),
} as unknown as Api
const kTheirs = put(kEmpty, { hand: 'right', kind: 'retraction', begin: 100, end: 200, state: 'accepted' })
const opened = async () => {
  const session = new PhasesSession(api, 'd', 'r')
  await vi.waitFor(() => expect(session.status).toBe('open'))
  return session
}
beforeEach(() => {
  localStorage.clear()
  ;[eaf, frames, print] = [emptyEaf('r.bvh', ''), 100, '1']
})

it('detects a changed annotation or motion, and whose phases are preserved', async () => {
  const session = await opened()
  expect(await session.renew()).toBe('same')
  eaf = eaf.replace('AUTHOR=""', 'AUTHOR="B"')
  expect([await session.renew(), session.conflicting, session.eaf.includes('"B"')]).toEqual(['annotation', [], true])
  eaf = writeChecked(eaf, kTheirs, 'B').text
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
  eaf = writeChecked(eaf, kTheirs, 'B').text
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
