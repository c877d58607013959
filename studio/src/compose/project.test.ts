import { expect, it } from 'vitest'
import { byMethod, bodyOf, pinned } from './body'
import { carried } from './carry'
import { fileOf } from './file'
import {
  changed,
  duplicated,
  firstChange,
  inserted,
  kEmpty,
  moved,
  piecePlace,
  removed,
  replaced,
  sameProject,
  signPlace,
  withHow,
  withJoin,
  withPause,
  withPlaces,
  withToken,
} from './project'
import { stateOf } from './state'
import { signs } from './test_places'

const glosses = (project: typeof kEmpty) => project.places.map((place) => (place.kind === 'sign' ? place.gloss : place.recording)).join(' ')
const abc = withPlaces(
  kEmpty,
  ['A', 'B', 'C'].map((gloss) => signPlace(gloss)),
)

it('inserts, removes, moves and duplicates, and leaves the original unchanged', () => {
  expect(glosses(inserted(abc, 1, signPlace('X'), signPlace('Y')))).toBe('A X Y B C')
  expect(glosses(removed(abc, 0))).toBe('B C')
  expect([moved(abc, 0, 2), moved(abc, 2, 0), moved(abc, 1, 9)].map(glosses)).toEqual(['B C A', 'C A B', 'A C B'])
  expect(moved(abc, 1, 1)).toBe(abc)
  const twice = duplicated(withPause(abc, 1, 'comma'), 1)
  expect(glosses(twice)).toBe('A B B C')
  expect(twice.places.map(({ pause }) => pause)).toEqual(['none', 'comma', 'none', 'none'])
  expect(new Set(twice.places.map(({ id }) => id)).size).toBe(4)
  expect(glosses(abc)).toBe('A B C')
})

it('moves pause and join with their place, and ignores those of the first place', () => {
  const joined = withJoin(withPause(abc, 1, 'stop'), 1, { method: 'gap', durationMs: 300 })
  expect(moved(joined, 1, 2).places[2]).toMatchObject({ pause: 'stop', join: { method: 'gap', durationMs: 300 } })
  const first = moved(joined, 1, 0)
  expect([bodyOf(first), stateOf(first), 'junction' in JSON.parse(fileOf(first, 'd')).places[0]]).toEqual([
    { utterance: 'B A C' },
    { utterance: 'B A C' },
    false,
  ])
  expect(sameProject(moved(first, 0, 1), joined)).toBe(true)
  expect([sameProject(first, withPlaces(kEmpty, signs('B', 'A', 'C'))), firstChange(first, withPlaces(kEmpty, signs('B', 'A', 'C')))]).toEqual([true, 3])
  expect(sameProject(moved(withPlaces(first, carried(first.places, signs('B', 'A', 'C'))), 0, 1), joined)).toBe(true)
  expect(withJoin(joined, 1, { durationMs: undefined }).places[1].join).toEqual({ method: 'gap' })
  expect(replaced(joined, 1, signPlace('Z', 4)).places[1]).toMatchObject({ gloss: 'Z', token: 4, pause: 'stop', id: joined.places[1].id })
})

it('finds the first difference of two projects', () => {
  expect([
    firstChange(abc, abc),
    firstChange(abc, withToken(abc, 2, 1)),
    firstChange(abc, withHow(abc, { tempo: 2 })),
    firstChange(abc, removed(abc, 2)),
  ]).toEqual([3, 2, 0, 2])
  const again = withPlaces(
    kEmpty,
    ['A', 'B', 'C'].map((gloss) => signPlace(gloss)),
  )
  expect([sameProject(abc, again), sameProject(abc, withPause(again, 1, 'comma')), sameProject(abc, { ...again, original: 'r' })]).toEqual([true, false, false])
})

it('is converted to the body of a call, without default values', () => {
  expect(bodyOf(abc)).toEqual({ utterance: 'A B C' })
  const how = withHow(abc, { transition: 'gap', duration: 400, tempo: 1.5, align: 'ground', rate: '30000/1001' })
  expect(bodyOf(withJoin(withJoin(how, 2, { durationMs: 450 }), 1, { method: 'hermite', tempo: 2 }))).toEqual({
    utterance: 'A B C',
    transition: 'gap',
    duration: 400,
    tempo: 1.5,
    align: 'ground',
    rate: '30000/1001',
    junctions: ['1=hermite,x2', '2=450ms'],
  })
})

it('is converted to another method, with the tokens pinned', () => {
  const project = changed(withJoin(withJoin(abc, 1, { method: 'gap' }), 2, { method: 'sine', durationMs: 200 }), 0, () => piecePlace('r', 1, 2))
  expect(bodyOf(pinned(byMethod(project, 'hermite'), [0, 3, 1]))).toEqual({ utterance: 'r@1..2 B#3 C#1', transition: 'hermite', junctions: ['2=200ms'] })
  expect(bodyOf(pinned(withToken(abc, 1, 7), [1, 2, 3])).utterance).toBe('A#1 B#7 C#3')
})
