import { expect, it } from 'vitest'
import { StudioFault } from './fault'
import type { Recording } from './schema'
import { changesOf, hasMotion, withMotion } from './types'

const kStill: Recording = {
  recording: 'r',
  signer: '',
  motion_file: '',
  face_file: '',
  annotation_file: 'r.eaf',
  phases: 0,
  phases_measured: 0,
  not_measured: '',
  annotation_fingerprint: 'none',
  notices: [],
}

it('distinguishes recordings with and without motion', () => {
  const moving = { ...kStill, frames: 3, frames_per_second: 50, clock_origin_ms: 0 }
  expect([hasMotion(kStill), withMotion(moving)]).toEqual([false, moving])
  expect(() => withMotion(kStill)).toThrow(new StudioFault('noMotion', 'r'))
})

it('returns the known changes of an import, and throws for others', () => {
  expect(changesOf({ changes: { motion: 'added', clock: 'replaced' } })).toEqual([
    ['motion', 'added'],
    ['clock', 'replaced'],
  ])
  expect(() => changesOf({ changes: { motion: 'moved' } })).toThrow(StudioFault)
  expect(() => changesOf({ changes: { smell: 'added' } })).toThrow(StudioFault)
})
