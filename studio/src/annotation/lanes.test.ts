import { expect, it } from 'vitest'
import { signAnswer, synthesisAnswer } from '../api/test_answers'
import { fr } from '../text/fr'
import { documentOf } from './made_document'

const clip = (id: number, place: number, begin: number, end: number, more = {}) => ({
  clip: id,
  place,
  recording: 'r',
  frames: { begin, end },
  kept_frames: { begin: begin + 10, end },
  kept_from_recorded_frame: 1000 * (id + 1),
  recorded_frames_per_frame: 2,
  ...more,
})
// A, then B; the left hand keeps its pose at the end of A until its own sign C, which accompanies B.
const kReport = synthesisAnswer({
  frames: 600,
  frames_per_second: 100,
  signs: [
    signAnswer({ gloss: 'A', place: 0, clip: 0, begin_ms: 0, end_ms: 2000 }),
    signAnswer({ gloss: 'B', place: 1, clip: 1, begin_ms: 3000, end_ms: 6000 }),
    signAnswer({ gloss: 'C', place: 1, clip: 2, begin_ms: 4000, end_ms: 5000, channel: 'left' }),
  ],
  clips: [clip(0, 0, 0, 200), clip(1, 1, 300, 600), clip(2, 1, 400, 500, { channel: 'left', recording: 's', mirrored: true })],
  junctions: [],
  lanes: [
    {
      channel: 'left',
      items: [
        { kind: 'clip', clip: 0, frames: { begin: 0, end: 150 } },
        { kind: 'hold', clip: 0, frames: { begin: 150, end: 360 } },
        { kind: 'transition', from_clip: 0, to_clip: 2, method: 'taught', frames: { begin: 360, end: 400 } },
        { kind: 'clip', clip: 2, frames: { begin: 400, end: 500 }, hand_kept_in: 'signer space', hand_moved_mm: 12.4 },
      ],
    },
    {
      channel: 'head',
      items: [
        { kind: 'hold', clip: 1, frames: { begin: 0, end: 310 } },
        { kind: 'clip', clip: 1, frames: { begin: 310, end: 600 } },
      ],
    },
  ],
  movements: [
    { name: 'pluie', kind: 'mouthing', channels: ['mouth'], first_place: 1, last_place: 1, frames: { begin: 320, end: 500 } },
    { name: 'q-polar', kind: 'expression', channels: ['head', 'brows'], first_place: 0, last_place: 1, frames: { begin: 0, end: 590 } },
    { name: 'topic', kind: 'expression', channels: ['brows'], first_place: 0, last_place: 0, frames: { begin: 10, end: 200 } },
    { name: 'brows up', kind: 'expression', channels: ['brows'], first_place: 1, last_place: 1, frames: { begin: 200, end: 300 } },
  ],
})
const named = (name: string, labels?: typeof fr) => documentOf(kReport, labels).tiers.find((tier) => tier.name === name)?.annotations

it('adds a row for each lane and each authored channel, and keeps those of the body as they are', () => {
  const { tiers } = documentOf(kReport)
  expect(tiers.map(({ name, annotations }) => [name, annotations.length])).toEqual([
    ['Gloss', 2],
    ['Phase', 0],
    ['Left hand', 4],
    ['Head', 2],
    ['Brows', 1],
    ['Brows 2', 2],
    ['Mouth', 1],
    ['Head motion', 1],
    ['Place', 2],
    ['Source', 2],
    ['Junction', 0],
  ])
})

it('says of each clip, hold and transition when it is, what it shows and where it comes from', () => {
  expect(named('Left hand')).toEqual([
    { begin: 0, end: 1500, label: 'A', kind: 'shared', detail: 'clip 0, place 0: r frames 980..1280, as the body' },
    { begin: 1500, end: 3600, label: 'hold: A', kind: 'hold', detail: 'pose of clip 0, place 0: r frame 1278' },
    { begin: 3600, end: 4000, label: 'taught', kind: 'transition', detail: 'clip 0 -> 2: taught 400 ms' },
    {
      begin: 4000,
      end: 5000,
      label: 'C',
      kind: 'clip',
      detail: 'clip 2, place 1: s frames 2980..3180, mirrored, hand kept in signer space, moved 12 mm',
    },
  ])
  expect(named('Main gauche', fr)![1]).toMatchObject({ label: 'tenue\u202f: A', detail: 'pose du clip 0, place 0\u202f: r image 1278' })
})

it('takes the pose before the first clip from the begin of that clip', () => {
  expect(named('Head')![0]).toMatchObject({ label: 'hold: B', detail: 'pose of clip 1, place 1: r frame 2000' })
})

it('puts movements that overlap on one channel below each other', () => {
  expect([named('Brows'), named('Brows 2')].map((row) => row!.map(({ label }) => label))).toEqual([['q-polar'], ['topic', 'brows up']])
  expect(named('Head motion')![0]).toEqual({ begin: 0, end: 5900, label: 'q-polar', kind: 'movement', detail: 'q-polar, with A B' })
  expect(named('Mouth')![0]).toMatchObject({ begin: 3200, end: 5000, label: '"pluie"', detail: '"pluie", with B' })
})
