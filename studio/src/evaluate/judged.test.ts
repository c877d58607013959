import { describe, expect, it } from 'vitest'
import type { Estimate, Judgement } from './evaluation'
import { readEvaluation } from './evaluation'
import { judgedCsv, judgedTable } from './judged'

const estimate = (value: number | null, low: number | null = null, high: number | null = null): Estimate => ({ value, low, high, spans: 5, recordings: 2 })
const judged = (method: string, all: Estimate, may: boolean, ...of: (readonly [string, Estimate])[]): Judgement => ({
  method,
  over: 'kriging',
  all,
  collections: of.map(([collection, one]) => ({ collection, ...one })),
  may_be_default: may,
})
const some = [
  judged('sine', estimate(1.2, 0.8, 1.5), false, ['a', estimate(1.3, 0.7, 1.6)], ['b', estimate(null)]),
  judged('learned', estimate(0.9, 0.85, 0.95), true, ['a', estimate(0.8, 0.7, 0.9)], ['b', estimate(1.01, 0.99, 1.03)]),
  judged('hermite', estimate(0.95, 0.9, 0.99), false, ['a', estimate(0.5, 0.4, 0.6)], ['b', estimate(1.4, 1.2, 1.6)]),
]

describe('judged methods', () => {
  it('have a column for each collection and one overall, and say which may be the default and why not', () => {
    const table = judgedTable(some)!
    expect(table.collections).toEqual(['a', 'b'])
    expect(table.over).toBe('kriging')
    expect(table.rows.map(({ method, verdict }) => [method, verdict])).toEqual([
      ['learned', 'yes'],
      ['hermite', 'worse'],
      ['sine', 'notBetter'],
    ])
    expect(table.rows.map(({ cells }) => cells.map((cell) => cell?.value))).toEqual([
      [0.8, 1.01, 0.9],
      [0.5, 1.4, 0.95],
      [1.3, undefined, 1.2],
    ])
  })
  it('have no column for a single collection', () => {
    const table = judgedTable([judged('sine', estimate(1.2, 1.1, 1.5), false, ['', estimate(1.2, 1.1, 1.5)])])!
    expect(table.collections).toEqual([])
    expect(table.rows).toEqual([{ method: 'sine', cells: [expect.objectContaining({ value: 1.2 })], verdict: 'worse' }])
  })
  it('give no table if there are none, as in an older file', () => {
    expect(judgedTable(undefined)).toBeUndefined()
    expect(judgedTable([])).toBeUndefined()
  })
  it('are saved with their intervals', () => {
    const [head, first] = judgedCsv(judgedTable(some)!)
    expect(head.slice(0, 6)).toEqual(['method', 'over', 'a', 'a low', 'a high', 'a spans'])
    expect(first).toEqual(['learned', 'kriging', 0.8, 0.7, 0.9, 5, 1.01, 0.99, 1.03, 5, 0.9, 0.85, 0.95, 5, 'yes'])
  })
  it('are read from a file, which is rejected if they are invalid', () => {
    const evaluation = { recordings: 1, tasks: [{ task: 'given', groups: [{ group: 'natural', spans: 1, recordings: 1, hands: {} }] }], spans: [] }
    expect(readEvaluation(JSON.stringify({ ...evaluation, judged: some })).judged).toEqual(some)
    for (const wrong of [
      'x',
      [null],
      [{ ...some[0], method: 3 }],
      [some[0], some[0]],
      [{ ...some[0], all: 1 }],
      [{ ...some[0], collections: [{ value: 1 }] }],
      [{ ...some[0], collections: {} }],
    ]) {
      expect(() => readEvaluation(JSON.stringify({ ...evaluation, judged: wrong })), JSON.stringify(wrong)).toThrow('noEvaluation')
    }
  })
})
