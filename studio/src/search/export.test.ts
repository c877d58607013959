import { expect, it } from 'vitest'
import { AnswerReader, type Answer } from './answers'
import { CsvReader } from './csv'
import { answerTier, csvOf, distinct, fileName, jsonOf } from './export'

const answer = (at: number, more: Partial<Answer> = {}): Answer => ({
  at,
  recording: 'meteo',
  tier: 'Gloss',
  name: 'LE "MANS", x',
  begin: 10,
  end: 20,
  ...more,
})

it('writes CSV that it can read', () => {
  const answers = [answer(0, { distance: 0.25, bindings: ['A,B'] }), answer(1, { distance: 1, bindings: [''] })]
  const reader = new AnswerReader()
  expect(reader.take(new CsvReader().push(csvOf(answers, true, ['$X'])))).toEqual(answers)
  expect(csvOf([answer(0)], false, [])).toBe('recording,tier,name,begin ms,end ms\nmeteo,Gloss,"LE ""MANS"", x",10,20\n')
})

it('selects the wanted answers from the server’s JSON, unless they have changed', () => {
  const found = [10, 30].map((begin_ms) => ({ recording: 'meteo', name: 'N', begin_ms, end_ms: 20, parts: [] }))
  expect(JSON.parse(jsonOf(found, [answer(0, { name: 'N' })])!)).toEqual([found[0]])
  expect(jsonOf(found, [answer(1, { name: 'N' })])).toBeUndefined()
  expect(jsonOf(found, [answer(7)])).toBeUndefined()
})

it('gives files valid and unique names', () => {
  expect(fileName(answer(0, { recording: 'a/b', name: 'LE MANS' }), 'bvh')).toBe('a-b_LE-MANS_10-20.bvh')
  expect(distinct(['a.bvh', 'a.bvh', 'b', 'b'])).toEqual(['a.bvh', 'a (2).bvh', 'b', 'b (2)'])
})

it('asks for tiers on which answers do not overlap', () =>
  expect(answerTier([answer(0, { name: 'A' })])).toEqual({
    name: 'query',
    type: 'query answers',
    spread: true,
    annotations: [{ begin_ms: 10, end_ms: 20, label: 'A' }],
  }))
