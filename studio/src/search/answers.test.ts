import { expect, it } from 'vitest'
import { AnswerReader, pieceText, quoted } from './answers'

it('reads answers with a distance and with variables', () => {
  const reader = new AnswerReader()
  expect(reader.take([['recording', 'tier', 'name', 'begin ms', 'end ms', 'distance', '$X', '$Y']])).toEqual([])
  expect(reader.take([['meteo', 'Gloss', 'MATIN', '1200', '-5', '0.358', 'A', '']])).toEqual([
    { at: 0, recording: 'meteo', tier: 'Gloss', name: 'MATIN', begin: 1200, end: -5, distance: 0.358, bindings: ['A', ''] },
  ])
  expect(reader.variables).toEqual(['$X', '$Y'])
})

it('reads how answers match words', () => {
  const reader = new AnswerReader()
  const [, first] = [
    reader.take([['recording', 'tier', 'name', 'begin ms', 'end ms', 'match']]),
    reader.take([['meteo', 'Gloss', 'MATIN', '1200', '1300', 'folded']]),
  ]
  expect(first).toEqual([{ at: 0, recording: 'meteo', tier: 'Gloss', name: 'MATIN', begin: 1200, end: 1300, match: 'folded' }])
  expect(reader.variables).toEqual([])
})

it('reads plain answers, and continues counting over several chunks', () => {
  const reader = new AnswerReader()
  reader.take([
    ['recording', 'tier', 'name', 'begin ms', 'end ms'],
    ['a', 'T', 'x', '0', '1'],
  ])
  const [second] = reader.take([['a', 'T', 'y', '1', '2']])
  expect(second).toEqual({ at: 1, recording: 'a', tier: 'T', name: 'y', begin: 1, end: 2, distance: undefined, bindings: undefined })
  expect(reader.ranked).toBe(false)
})

it('names a piece as in queries and utterances', () => {
  expect(pieceText({ recording: 'a "b"', begin: 1200, end: 3400 })).toBe('"a \\"b\\""@1200..3400')
  expect(quoted('a\\b\n')).toBe('"a\\\\b\\n"')
})
