import { describe, expect, it } from 'vitest'
import { csvOf } from './csv'
import { figureOf, gapOf, readEvaluation, spansByRecording, wholeGroups, type Estimate, type Evaluation } from './evaluation'
import { bestOf, farness, kDurations, kMeasures, measuresOf } from './measures'
import { inOrder, isBound } from './methods'
import { countsOf, csvRows, sorted, tableByGroup, tableByMeasure } from './table'

const estimate = (value: number | null, low: number | null = null, high: number | null = null): Estimate => ({ value, low, high, spans: 5, recordings: 2 })
const wrist = (value: number, over: number) => ({ ...estimate(value, value - 1, value + 1), unit: 'mm', over_slerp: estimate(over) })
const scores = {
  slerp: { wrist: wrist(20, 1), peak_speed_ratio: estimate(0.5), duration_error: estimate(110) },
  ceiling: { wrist: wrist(2, 0.1) },
  learned: { wrist: wrist(9, 0.45), peak_speed_ratio: estimate(1.25), duration_error: estimate(110) },
  hermite: { wrist: wrist(11, 0.55), peak_speed_ratio: estimate(null) },
}
const evaluation: Evaluation = {
  recordings: 2,
  recordings_left_out: 0,
  spans_left_out: 1,
  seed: 1,
  confidence: 0.95,
  tasks: [
    {
      task: 'given',
      groups: [
        { group: '170 ms', spans: 5, recordings: 2, hands: { moving: scores } },
        { group: '170 ms, long, 1 peak', spans: 2, recordings: 1, hands: { moving: scores } },
        { group: 'natural', spans: 7, recordings: 2, hands: { moving: { slerp: { wrist: wrist(30, 1) }, learned: { wrist: wrist(31, 1.03) } } } },
      ],
    },
  ],
  spans: [
    { file: 'a', first_frame: 3, frames: 17, group: '170 ms' },
    { file: 'b', first_frame: 3, frames: 17, group: '170 ms' },
    { file: 'b', first_frame: 50, frames: 30, group: 'natural' },
  ],
}
const [task] = evaluation.tasks
const measure = (name: string) => kMeasures.find((one) => one.measure === name)!

describe('an evaluation', () => {
  it('is read from what was written, and anything else is rejected', () => {
    expect(readEvaluation(JSON.stringify(evaluation))).toEqual(evaluation)
    for (const wrong of ['', 'null', '{}', '[]', '{"tasks":[],"spans":[]}', '{"tasks":[{"task":"given","groups":[{}]}],"spans":[],"recordings":1}']) {
      expect(() => readEvaluation(wrong), wrong).toThrow('noEvaluation')
    }
  })
  it('is rejected if required data is missing', () => {
    const group = evaluation.tasks[0].groups[0]
    const tasks = (...groups: unknown[]) => ({ tasks: [{ task: 'given', groups }] })
    const odd: Record<string, unknown> = {
      noTask: { tasks: [] },
      noGroup: tasks(),
      twice: tasks(group, group),
      sameTask: { tasks: [evaluation.tasks[0], evaluation.tasks[0]] },
      nullScores: tasks({ ...group, hands: { moving: { learned: null } } }),
      textScores: tasks({ ...group, hands: { moving: 'x' } }),
      listHands: tasks({ ...group, hands: [] }),
      nullFigure: tasks({ ...group, hands: { moving: { learned: { wrist: null } } } }),
      textValue: tasks({ ...group, hands: { moving: { learned: { wrist: { value: '9' } } } } }),
      oddOver: tasks({ ...group, hands: { moving: { learned: { wrist: { value: 9, over_slerp: 1 } } } } }),
      noCounts: tasks({ group: '170 ms', hands: {} }),
      nullSpan: { spans: [null] },
      nameless: { spans: [{ frames: 3 }] },
      textNotice: { notices: ['x'] },
      listDeclared: { declarations: ['x'] },
      plot: { plot: 3 },
    }
    for (const [what, more] of Object.entries(odd))
      expect(() => readEvaluation(JSON.stringify({ ...evaluation, ...(more as object) })), what).toThrow('noEvaluation')
    // A task without results may stand next to one with results.
    expect(readEvaluation(JSON.stringify({ ...evaluation, tasks: [...evaluation.tasks, { task: 'replaced', groups: [] }] })).tasks).toHaveLength(2)
  })
  it('has figures by method and measure, or relative to another method', () => {
    expect(figureOf(scores, 'learned', 'wrist')?.value).toBe(9)
    expect(figureOf(scores, 'learned', 'wrist/slerp')?.value).toBe(0.45)
    expect(figureOf(scores, 'hermite', 'peak_speed_ratio')).toBeUndefined()
    expect(figureOf(undefined, 'hermite', 'wrist')).toBeUndefined()
  })
  it('recognizes gaps of one length, and parts of groups', () => {
    expect(gapOf('170 ms')).toBe(170)
    expect(gapOf('natural')).toBeUndefined()
    expect(wholeGroups(task).map(({ group }) => group)).toEqual(['170 ms', 'natural'])
  })
  it('counts the spans of recordings', () => {
    expect(spansByRecording(evaluation.spans).map(({ recording, spans }) => [recording, spans])).toEqual([
      ['b', 2],
      ['a', 1],
    ])
  })
  it('reports the duration error once for all methods', () => {
    expect(countsOf(task, kDurations)[0].durations[0]?.value).toBe(110)
    expect(measuresOf(task).map((one) => one.measure)).toEqual(['wrist/slerp', 'wrist', 'peak_speed_ratio'])
  })
})

describe('the best figure', () => {
  it('is the lowest, or the nearest to one as a ratio or to zero', () => {
    expect(farness(0.5, 'one')).toBeCloseTo(farness(2, 'one'))
    expect(farness(-0.2, 'zero')).toBe(0.2)
    expect([...tableByMeasure(task.groups[0], 'moving', [measure('peak_speed_ratio')]).best[0]]).toEqual(['learned'])
  })
  it("is never a bound's, which knows the answer, and is undefined if all are equal", () => {
    expect([...tableByGroup(wholeGroups(task), 'moving', measure('wrist')).best[0]]).toEqual(['learned'])
    expect(
      bestOf(
        [
          ['a', estimate(0)],
          ['b', estimate(0)],
        ],
        'low',
        isBound,
      ).size,
    ).toBe(0)
    expect([
      ...bestOf(
        [
          ['a', estimate(0)],
          ['b', estimate(0)],
          ['c', estimate(1)],
        ],
        'low',
        isBound,
      ),
    ]).toEqual(['a', 'b'])
  })
})

describe('a table', () => {
  it('has the methods in their order, and sorts those without a figure last', () => {
    const table = tableByGroup(wholeGroups(task), 'moving', measure('wrist'))
    expect(table.rows.map(({ method }) => method)).toEqual(['learned', 'hermite', 'slerp', 'ceiling'])
    expect(sorted(table, { column: 1, down: false }).map(({ method }) => method)).toEqual(['slerp', 'learned', 'hermite', 'ceiling'])
    expect(sorted(table, { column: 1, down: true }).map(({ method }) => method)).toEqual(['learned', 'slerp', 'hermite', 'ceiling'])
    expect(inOrder(['zzz', 'hold', 'learned'])).toEqual(['learned', 'hold', 'zzz'])
  })
  it('is written to a file with intervals and counts', () => {
    const table = tableByGroup(wholeGroups(task).slice(0, 1), 'moving', measure('wrist'))
    expect(csvOf(csvRows(table, table.rows.slice(0, 1), { task: 'given' }))).toBe(
      'task,method,170 ms (mm),170 ms (mm) low,170 ms (mm) high,170 ms (mm) spans\r\ngiven,learned,9,8,10,5\r\n',
    )
  })
})

describe('CSV', () => {
  it('quotes fields as in RFC 4180', () => {
    expect(csvOf([['a,b', 'say "no"', 'two\nlines', null, undefined, 1.5, 'plain é']])).toBe('"a,b","say ""no""","two\nlines",,,1.5,plain é\r\n')
  })
  it('prevents text from being interpreted as a formula, and leaves numbers unchanged', () => {
    expect(csvOf([['=P"1,x', '+1', '-1', '@a', '\tb', '\rc', "it's", 'a=b', -1.5, +2, '']])).toBe(`"'=P""1,x",'+1,'-1,'@a,'\tb,"'\rc",it's,a=b,-1.5,2,\r\n`)
  })
})
