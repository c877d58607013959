import { expect, it } from 'vitest'
import { documentOf } from '../annotation/made_document'
import type { Candidate } from '../api/schema'
import { joinAnswer, junctionAnswer, synthesisAnswer } from '../api/test_answers'
import type { ExplainedSynthesis } from '../api/types'
import { en } from '../text/en'
import { candidatesOf, chosenTokens } from './candidates'
import { Known, layoutOf } from './layout'
import { piecePlace, signPlace } from './project'
import { signs } from './test_places'

const sign = (gloss: string, place: number, clip: number, begin: number, end: number, recording: string, from: number) => ({
  gloss,
  place,
  clip,
  begin_ms: begin,
  end_ms: end,
  recording,
  recorded: { begin_ms: from, end_ms: from + (end - begin) },
  phases: [
    { kind: 'preparation', begin_ms: begin, end_ms: begin + 100 },
    { kind: 'stroke', begin_ms: begin + 100, end_ms: end - 100 },
  ],
})
const clipOf = (clip: number, place: number, recording: string, begin: number, end: number) => ({
  clip,
  place,
  recording,
  frames: { begin, end },
  kept_frames: { begin: begin + 5, end },
  kept_from_recorded_frame: 105,
  recorded_frames_per_frame: 1,
})
const junction = (clip: number, begin: number, end: number) => junctionAnswer({ to_clip: clip, frames: { begin, end } })

// A and B were recorded one after the other and stay so; then a piece that contains C and D, an empty piece, and E.
const kReport = synthesisAnswer({
  frames: 1000,
  frames_per_second: 100,
  signs: [
    sign('A', 0, 0, 0, 1000, 'r', 0),
    sign('B', 1, 0, 1000, 2000, 'r', 1000),
    sign('C', 2, 1, 2500, 3500, 's', 5000),
    sign('D', 2, 1, 3500, 4500, 's', 6000),
    sign('E', 4, 3, 8000, 10_000, 'r', 9000),
  ],
  clips: [clipOf(0, 0, 'r', 0, 200), clipOf(1, 2, 's', 240, 460), clipOf(2, 3, 's', 500, 700), clipOf(3, 4, 'r', 790, 1000)],
  junctions: [junction(1, 200, 245), junction(2, 460, 505), junction(3, 700, 795)],
})
const kPlaces = [...signs('A', 'B'), piecePlace('s', 4000, 7000), piecePlace('s', 100, 200), signPlace('E')]

it('finds each place, also if pieces contain several signs or none', () => {
  const { places, seams } = layoutOf(kPlaces, kReport)!
  expect(places.map(({ begin, end, clip, signs }) => [begin, end, clip, signs.length])).toEqual([
    [0, 1, 0, 1],
    [1, 2, 0, 1],
    [2.5, 4.5, 1, 2],
    [5, 7, 2, 0],
    [8, 10, 3, 1],
  ])
  expect(seams.map((seam) => seam && [seam.kind, seam.begin, seam.end])).toEqual([
    undefined,
    ['kept', 0.9, 1.1],
    ['made', 2, 2.45],
    ['made', 4.6, 5.05],
    ['made', 7, 7.95],
  ])
  expect(seams[2]).toMatchObject({ method: 'gap', retraction: 1, preparation: 2, blend: 3 })
})

it('knows the positions of places that have moved since, but not their junctions', () => {
  const known = new Known(kPlaces, layoutOf(kPlaces, kReport)!)
  const [a, b, c] = kPlaces.map(({ id }) => id)
  expect([known.place(c)?.begin, known.seam(b, a)?.kind, known.seam(c, b)?.kind, known.seam(c, a), known.place(-1)]).toEqual([
    2.5,
    'kept',
    'made',
    undefined,
    undefined,
  ])
  expect([known.at(0), known.at(2.7), known.at(99)]).toEqual([a, c, undefined])
})

it('leaves out the signs of single channels', () => {
  const left = { ...sign('X', 0, 9, 100, 8000, 's', 0), channel: 'left' as const }
  const clip = { ...clipOf(9, 0, 's', 10, 800), channel: 'left' as const }
  expect(layoutOf(kPlaces, { ...kReport, signs: [left, ...kReport.signs], clips: [clip, ...kReport.clips] })).toEqual(layoutOf(kPlaces, kReport))
})

it('returns nothing for places that do not match the report', () => {
  expect(layoutOf(signs('A', 'B'), kReport)).toBeUndefined()
  expect(layoutOf(signs('A', 'B', 'C', 'D', 'E', 'F'), kReport)).toBeUndefined()
})

it('builds the annotation of a result like its EAF', () => {
  const { tiers } = documentOf(kReport)
  expect(tiers.map(({ name, annotations }) => [name, annotations.length])).toEqual([
    ['Gloss', 5],
    ['Phase', 10],
    ['Place', 5],
    ['Source', 4],
    ['Junction', 3],
  ])
  expect(tiers[2].annotations[1].label).toBe('1, clip 0')
  expect(tiers[3].annotations[1]).toEqual({ begin: 2400, end: 4600, label: 'clip 1, place 2: s frames 100..320' })
  expect(tiers[4].annotations[0].label).toBe('clip 0 -> 1: gap 450 ms: A -> B (m_i 1, m_j 2, p 3)')
  expect(tiers[1].annotations[1]).toEqual({ begin: 100, end: 900, label: 'Stroke' })
  const other = documentOf(kReport, {
    ...en,
    preparation: 'P',
    stroke: 'S',
    retraction: 'R',
    madePlace: 'p {place}',
    madeSource: '{recording}, images {from} à {to}',
    madeSeam: '{method} en {ms} ms',
  }).tiers
  expect([other[1].annotations[1].label, other[3].annotations[1].label, other[4].annotations[0].label]).toEqual(['S', 's, images 100 à 320', 'gap en 450 ms'])
})

it('returns the candidates of a place by their tokens, cheapest first, with their cost terms', () => {
  const row = (token: number, cost: number, more: Partial<Candidate> = {}): Candidate => ({
    recording: 'r',
    token,
    frames: { begin: 10 * token, end: 10 * token + 5 },
    cost,
    target_cost: 0.1,
    target: { left: 0.1, defects: 0 },
    ...more,
  })
  const report: ExplainedSynthesis = {
    ...kReport,
    places: [
      { candidates: [row(1, 2), row(3, 1)], chosen: 1, join_cost: 0 },
      {
        candidates: [
          row(2, 3.3, { join_cost: 0.7, join: joinAnswer({ arms: 0.4, place: 0.3 }) }),
          row(4, 1, { kept: true, join_cost: 0, join: joinAnswer({ arms: 9 }) }),
        ],
        chosen: 0,
        join_cost: 0.7,
      },
    ],
  }
  expect(candidatesOf(report, 0).map(({ token, best, frame }) => [token, best, frame])).toEqual([
    [3, true, 30],
    [1, false, 10],
  ])
  const [first, second] = candidatesOf(report, 1)
  expect([first.token, first.kept, first.best, first.terms]).toEqual([
    4,
    true,
    false,
    [
      { name: 'after', of: 'join', cost: 0.9 },
      { name: 'left', of: 'target', cost: 0.1 },
    ],
  ])
  expect(second.terms.map(({ name }) => name)).toEqual(['after', 'arms', 'place', 'left'])
  expect(chosenTokens(report)).toEqual([3, 2])
})
