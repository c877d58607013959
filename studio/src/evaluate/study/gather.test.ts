// @vitest-environment jsdom
import { expect, it } from 'vitest'
import type { RecordingRow } from '../../api/schema'
import type { Api } from '../../api/client'
import { ApiError, StudioFault } from '../../api/fault'
import { gatherSources } from './gather'
import { marksOf, strangersOf } from './recordings'
import type { Item, Study } from './study'

const slot = (id: string, ms: number) => `<TIME_SLOT TIME_SLOT_ID="${id}" TIME_VALUE="${ms}"/>`
const sign = (id: string, from: string, to: string) =>
  `<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="${id}" TIME_SLOT_REF1="${from}" TIME_SLOT_REF2="${to}">
  <ANNOTATION_VALUE>${id}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>`
const kEaf = `<ANNOTATION_DOCUMENT><TIME_ORDER>${slot('t1', 500)}${slot('t2', 1000)}${slot('t3', 1400)}${slot('t4', 2000)}</TIME_ORDER>
<TIER TIER_ID="Gloss">${sign('A', 't1', 't2')}${sign('B', 't3', 't4')}</TIER></ANNOTATION_DOCUMENT>`

const apiOf = (annotation: Record<string, string | Error>) =>
  ({
    recording: async () => ({ frames: 300, frames_per_second: 100, clock_origin_ms: 0 }),
    annotation: async (_: string, name: string) => {
      const one = annotation[name]
      if (typeof one === 'string') return one
      throw one
    },
  }) as unknown as Api
const gathered = (api: Api, names: string[]) => gatherSources(api, 'demo', names, 500, () => {}, new AbortController().signal)

it('names the recordings whose annotation cannot be read, and continues with the others', async () => {
  const api = apiOf({
    a: kEaf,
    cut: kEaf.slice(0, 90),
    none: new ApiError('no annotation', 404, 'not_found'),
    bad: new ApiError('an invalid EAF', 422, 'unsupported'),
    b: kEaf,
  })
  const { sources, leftOut } = await gathered(api, ['a', 'cut', 'none', 'bad', 'b'])
  expect(sources.map(({ recording, from, to }) => [recording, from, to])).toEqual([
    ['a', 1000, 1400],
    ['b', 1000, 1400],
  ])
  expect(leftOut).toEqual(['cut', 'bad'])
})
it('leaves nothing out for a fault that is not specific to a recording', async () => {
  await expect(gathered(apiOf({ a: new StudioFault('unreachable') }), ['a'])).rejects.toThrow('unreachable')
  await expect(gathered(apiOf({ a: new ApiError('a token', 401, 'unauthorized') }), ['a'])).rejects.toThrow('a token')
})

it('identifies recordings by more than their names', () => {
  const row = (name: string, frames = 300) => ({ name, frames, frames_per_second: 100, joints: 60 }) as RecordingRow
  const items = ['b', 'a', 'b'].map((recording) => ({ recording }) as Item),
    recordings = marksOf(items, [row('a'), row('b'), row('c')])
  expect(Object.keys(recordings)).toEqual(['a', 'b'])
  const study = { items, recordings } as unknown as Study
  expect(strangersOf(study, [row('a'), row('b')])).toEqual([])
  expect(strangersOf(study, [row('a', 299), row('c')])).toEqual(['a', 'b'])
  // An older study contains only the names.
  expect(strangersOf({ items } as unknown as Study, [row('a', 299)])).toEqual(['b'])
})
