import { expect, it, vi } from 'vitest'
import type { Synthesis } from '../api/schema'
import { junctionAnswer, signAnswer, synthesisAnswer } from '../api/test_answers'
import type { Api } from '../api/client'
import type { Strand } from '../viewer/showing'
import { Making, type SigningRequest } from './making.svelte'
import { kEmpty, removed, signPlace, withPlaces, type Project } from './project'

const kRate = 50
/** The report of n signs of a second each, half a second apart. */
function reportOf(n: number): Synthesis {
  const range = (begin: number, end: number) => ({ begin: begin * kRate, end: end * kRate })
  const each = Array.from({ length: n }, (_, k) => k * 1.5)
  return synthesisAnswer({
    frames: 1.5 * n * kRate,
    frames_per_second: kRate,
    signs: each.map((at, k) => signAnswer({ place: k, clip: k, begin_ms: 1000 * at, end_ms: 1000 * (at + 1) })),
    clips: each.map((at, k) => ({
      clip: k,
      place: k,
      recording: 'r',
      frames: range(at, at + 1),
      kept_frames: range(at, at + 1),
      kept_from_recorded_frame: 0,
      recorded_frames_per_frame: 1,
    })),
    junctions: each.slice(1).map((at, k) => junctionAnswer({ to_clip: k + 1, frames: range(at - 0.5, at) })),
  })
}
/** Shows a project as if the server had answered. */
function show(making: Making, project: Project) {
  const report = reportOf(project.places.length)
  const motion = {
    report,
    store: { rate: kRate, seconds: report.frames / kRate, length: report.frames, arrived: report.frames },
    declarations: {},
    originMs: 0,
  }
  const request: SigningRequest = { project, title: '' }
  making['show'](request, [{ role: 'made', source: { complete: true, close() {} }, motion } as unknown as Strand])
}
const abcd = withPlaces(
  kEmpty,
  ['A', 'B', 'C', 'D'].map((gloss) => signPlace(gloss)),
)
const around = ({ transport: { loop } }: Making) => loop && [loop.begin, loop.end].map((at) => Math.round(100 * at) / 100)

it('keeps looping a moved junction, and ends the loop of a removed one', () => {
  const making = new Making({} as Api, 'd')
  show(making, abcd)
  expect(making.loopAround(abcd.places[3].id)).toBe(true)
  expect(around(making)).toEqual([3.6, 4.9])
  show(making, removed(abcd, 1))
  expect(around(making)).toEqual([2.1, 3.4])
  show(making, removed(abcd, 3))
  expect([around(making), making.around]).toEqual([null, undefined])
})

it('does not change a loop set by the user', () => {
  const making = new Making({} as Api, 'd')
  show(making, abcd)
  making.loopAround(abcd.places[3].id)
  making.transport.setLoop(0.5, 1)
  show(making, removed(abcd, 1))
  expect(around(making)).toEqual([0.5, 1])
})

it('stops fetching the compared recording if it fails, and if the comparison is closed', async () => {
  const closed: string[] = []
  const api = {
    recording: () => new Promise(() => {}),
    signs: vi.fn(async (_: string, name: string) => {
      if (name === 'bad') throw new Error('gone')
      return []
    }),
  } as unknown as Api
  const making = new Making(api, 'd')
  const ask = (name: string) => {
    const strand = making['originalStrand'](name, undefined)
    const { opening } = making['recorded']!,
      close = opening.close.bind(opening)
    opening.close = () => (closed.push(name), close())
    return strand
  }
  void ask('good')
  await expect(ask('bad')).rejects.toThrow('gone')
  expect([closed, making['recorded']?.key]).toEqual([['bad'], '["good",null]'])
  making.make({ project: kEmpty, title: '' }, undefined)
  expect([closed, making['recorded']]).toEqual([['bad', 'good'], undefined])
})
