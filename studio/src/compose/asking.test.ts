import { expect, it } from 'vitest'
import { askingOf } from './asking'
import { glossesOf } from './complete'
import { kEmpty, piecePlace, signPlace, withJoin, withPlaces } from './project'

const glosses = glossesOf([
  { gloss: 'A', tokens: 2 },
  { gloss: 'B', tokens: 1 },
])
const recordings = new Map([['r', 50]])
const places = [
  signPlace('X'),
  signPlace('A', 2),
  piecePlace('gone', 1, 20),
  signPlace('Y'),
  signPlace('B', 9, 'comma'),
  signPlace('B'),
  piecePlace('r', 1, 20),
  signPlace('A'),
]
const project = withJoin(withPlaces(kEmpty, places), 5, { method: 'gap' })

it('requests token costs without the places that the database does not know', () => {
  const utterance = 'A#2 B r@1..20 A'
  expect(askingOf(project, 1, glosses, recordings)).toEqual({ body: { utterance: 'A B r@1..20 A', junctions: ['1=gap'] }, at: 0 })
  expect(askingOf(project, 5, glosses, recordings)).toEqual({ body: { utterance, junctions: ['1=gap'] }, at: 1 })
  expect(askingOf(project, 7, glosses, recordings)).toEqual({ body: { utterance, junctions: ['1=gap'] }, at: 3 })
  expect(askingOf(project, 4, glosses, recordings)).toEqual({ body: { utterance: 'A#2 , B B r@1..20 A', junctions: ['2=gap'] }, at: 1 })
})

it('requests nothing for a place that is unknown or not a sign', () => {
  expect([0, 2, 3, 6, 8].map((at) => askingOf(project, at, glosses, recordings))).toEqual([undefined, undefined, undefined, undefined, undefined])
  expect(askingOf(project, 3, undefined, new Map())).toEqual({ body: { utterance: 'X A#2 gone@1..20 Y , B#9 B r@1..20 A', junctions: ['5=gap'] }, at: 3 })
})
