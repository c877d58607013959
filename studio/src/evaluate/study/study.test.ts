import { describe, expect, it } from 'vitest'
import type { AnnotationDocument } from '../../annotation/document'
import { csvOf } from '../csv'
import { gapsOf, kLongest, shownOf, usable } from './gaps'
import { defaultsOf, labelsOf } from './labels'
import { Random } from './random'
import { readStudy } from './read_study'
import { begin, isAnswered, itemsOf, keepDraft, kFormat, leave, sessionOf, stepsOf, trialsOf, vote, type Settings, type Source, type Study } from './study'
import { isOver, kColumns, outcomes, voteRows, votesOf, wilson } from './votes'

const settings: Settings = {
  seed: 7,
  mode: 'pair',
  methods: ['learned', 'gap', 'sine'],
  trials: 20,
  catches: 3,
  around: 1000,
  order: 'own',
  recorded: true,
  natural: false,
  rating: true,
  comment: true,
  speed: false,
  turn: false,
  character: null,
  labels: defaultsOf('pair'),
}
const sources: readonly Source[] = Array.from({ length: 12 }, (_, i) => ({
  recording: i % 2 ? 'a' : 'b',
  from: 1000 * i + 1000,
  to: 1000 * i + 1400,
  begin: 1000 * i,
  end: 1000 * i + 2400,
  signs: `S${i} S${i + 1}`,
}))
const studyOf = (more: Partial<Settings> = {}): Study => {
  const all = { ...settings, ...more }
  return {
    format: kFormat,
    database: 'demo',
    version: 'signweave 0.1.0',
    at: '2026-01-01T00:00:00Z',
    settings: all,
    items: itemsOf(sources, all),
    sessions: [],
  }
}
const counted = <T>(list: readonly T[]) => list.reduce((map, one) => map.set(one, (map.get(one) ?? 0) + 1), new Map<T, number>())

describe('a random order', () => {
  it('is the same for the same seed and differs for another', () => {
    const first = (seed: number, who = '') =>
      Array.from(
        { length: 4 },
        (
          (random) => () =>
            random.below(1000)
        )(new Random(seed, who)),
      )
    expect(first(1)).toEqual(first(1))
    expect(first(1)).not.toEqual(first(2))
    expect(first(1)).not.toEqual(first(1, 'P01'))
    expect(first(1)).toEqual([868, 664, 792, 536])
  })
  it('is fair', () => {
    const random = new Random(3),
      all = Array.from({ length: 6000 }, () => random.shuffled([0, 1, 2]).join(''))
    for (const [, count] of counted(all)) expect(count).toBeGreaterThan(880)
    expect(counted(all).size).toBe(6)
  })
})

describe('the items', () => {
  it('have each method equally often, and no gap twice with one method', () => {
    const items = itemsOf(sources, settings)
    expect(items).toHaveLength(23)
    const methods = counted(items.map(({ method }) => method))
    expect(methods.get('')).toBe(3)
    expect(['learned', 'gap', 'sine'].map((method) => methods.get(method)).toSorted()).toEqual([6, 7, 7])
    expect(counted(items.map(({ method, from }) => `${method} ${from}`)).size).toBe(23)
    expect(counted(items.slice(0, 12).map(({ from }) => from)).size).toBe(12)
  })
  it('repeat gaps evenly if there are too few', () => {
    const items = itemsOf(sources.slice(0, 3), { ...settings, trials: 18, catches: 0 })
    expect([...counted(items.map(({ from }) => from)).values()]).toEqual([6, 6, 6])
    expect([...counted(items.map(({ method, from }) => `${method} ${from}`)).values()]).toEqual(Array(9).fill(2))
  })
  it('depend on the seed alone', () => {
    expect(itemsOf(sources, settings)).toEqual(itemsOf(sources, { ...settings }))
    expect(itemsOf(sources, settings)).not.toEqual(itemsOf(sources, { ...settings, seed: 8 }))
    expect(itemsOf([], settings)).toEqual([])
  })
})

describe('trials', () => {
  const items = itemsOf(sources, settings)
  it('show every item once, with balanced sides for each method and overall', () => {
    for (let seed = 0; seed < 50; ++seed) {
      const trials = trialsOf(items, { seed, order: 'own' }, 'P01')
      expect(trials.map(({ item }) => item).toSorted((a, b) => a - b)).toEqual(items.map((_, i) => i))
      for (const method of ['learned', 'gap', 'sine']) {
        const mine = trials.filter(({ item }) => items[item].method === method)
        expect(Math.abs(mine.length - 2 * mine.filter(({ side }) => side === 'left').length)).toBeLessThanOrEqual(1)
      }
      const real = trials.filter(({ item }) => items[item].method)
      expect(Math.abs(real.length - 2 * real.filter(({ side }) => side === 'left').length)).toBeLessThanOrEqual(1)
    }
  })
  it('come in a separate order for each participant, or in one for all', () => {
    const own = { seed: 1, order: 'own' } as const,
      same = { seed: 1, order: 'same' } as const
    expect(trialsOf(items, own, 'P01')).toEqual(trialsOf(items, own, 'P01'))
    expect(trialsOf(items, own, 'P01')).not.toEqual(trialsOf(items, own, 'P02'))
    expect(trialsOf(items, same, 'P01')).toEqual(trialsOf(items, same, 'P02'))
  })
  it('spread the methods over a session', () => {
    const trials = trialsOf(items, { seed: 4, order: 'own' }, 'x').filter(({ item }) => items[item].method)
    for (let i = 0; i + 3 <= 18; i += 3) expect(new Set(trials.slice(i, i + 3).map(({ item }) => items[item].method)).size).toBe(3)
  })
  it('reveal no side by any pattern: over seeds each side is equally frequent', () => {
    let left = 0
    for (let seed = 0; seed < 400; ++seed) left += Number(trialsOf(items, { seed, order: 'own' }, '')[0].side === 'left')
    expect(left).toBeGreaterThan(160)
    expect(left).toBeLessThan(240)
  })
})

describe('gaps', () => {
  const document: AnnotationDocument = {
    tiers: [
      {
        name: 'Gloss',
        depth: 0,
        annotations: [
          { begin: 1000, end: 2000, label: 'A' },
          { begin: 2000, end: 3000, label: 'B' },
          { begin: 4000, end: 5000, label: 'C' },
        ],
      },
      {
        name: 'Phase',
        parent: 'Gloss',
        depth: 1,
        annotations: [
          { begin: 1000, end: 1200, label: 'Preparation' },
          { begin: 1200, end: 1500, label: 'Stroke' },
          { begin: 1500, end: 1700, label: 'Stroke' },
          { begin: 1700, end: 2000, label: 'Retraction' },
          { begin: 2000, end: 2300, label: 'Preparation' },
          { begin: 2300, end: 2700, label: 'Stroke' },
          { begin: 2700, end: 3000, label: 'Retraction' },
        ],
      },
    ],
  }
  it('range from the last stroke to the first of the next sign, if both have strokes', () => {
    expect(gapsOf(document)).toEqual([{ from: 1700, to: 2300, signs: 'A B' }])
  })
  it('are those between signs if no phases are annotated', () => {
    expect(gapsOf({ tiers: document.tiers.slice(0, 1) })).toEqual([{ from: 3000, to: 4000, signs: 'B C' }])
    expect(gapsOf({ tiers: [] })).toEqual([])
  })
  it('need capture on both sides, a perceptible length, and no defect nearby', () => {
    const captured = { begin: 0, end: 6000 }
    const gap = (from: number, to: number) => ({ from, to, signs: '' })
    const all = [gap(100, 500), gap(1700, 2300), gap(3000, 3050), gap(3000, 3001 + kLongest), gap(5000, 5800), gap(4000, 4400)]
    expect(usable(all, captured, [])).toEqual([all[1], all[5]])
    expect(usable(all, captured, [{ begin: 4600, end: 4610 }])).toEqual([all[1]])
    expect(shownOf(all[1], captured, 1000)).toEqual({ begin: 700, end: 3300 })
    expect(shownOf(all[1], { begin: 900.4, end: 3000 }, 1000)).toEqual({ begin: 901, end: 3000 })
  })
})

describe('a study', () => {
  const answer = (more: object = {}) => ({ recorded: 'left' as const, comment: '', plays: 2, ms: 3000, at: '2026-01-01T10:00:00.000Z', ...more })
  it('asks the questions that were set up', () => {
    expect(stepsOf(settings)).toEqual(['recorded', 'rating', 'comment'])
    expect(stepsOf({ ...settings, mode: 'single', natural: true })).toEqual(['recorded', 'rating', 'comment'])
    expect(['recorded', 'rating', 'comment'].map((step) => isAnswered(step as 'recorded', { recorded: 'left' }))).toEqual([true, false, true])
  })
  it('lets participants take turns, and each continue where they stopped', () => {
    let study = begin(studyOf(), 'P01', 'deaf')
    study = vote(study, answer())
    study = keepDraft(study, { recorded: 'right', plays: 1 })
    study = begin(leave(study), 'P02', 'learner')
    expect(sessionOf(study)?.answers).toHaveLength(0)
    study = begin(study, 'P01', 'none')
    expect(sessionOf(study)).toMatchObject({ fluency: 'deaf', draft: { recorded: 'right', plays: 1 } })
    study = vote(study, answer())
    expect(sessionOf(study)?.draft).toBeUndefined()
    expect(isOver(study)).toBe(false)
    while (!isOver(study)) study = vote(study, answer())
    expect(vote(study, answer())).toBe(study)
    expect(readStudy(JSON.stringify(study))).toEqual(study)
  })
  it('reads nothing else', () => {
    const good = begin(studyOf(), 'P01', 'deaf')
    for (const wrong of [
      '',
      '{}',
      'null',
      JSON.stringify({ ...good, format: 'x' }),
      JSON.stringify({ ...good, sessions: [{ ...good.sessions[0], trials: [{ item: 99, side: 'left' }] }] }),
    ]) {
      expect(() => readStudy(wrong), wrong.slice(0, 40)).toThrow('noStudy')
    }
  })
  it('has a row for every vote', () => {
    let study = begin(studyOf({ natural: true }), 'P"1"', 'deaf')
    while (!isOver(study)) {
      const session = sessionOf(study)!,
        { side } = session.trials[session.answers.length]
      study = vote(study, answer({ recorded: side, natural: side === 'left' ? 'right' : 'left', rating: 4, comment: 'a, b' }))
    }
    const rows = voteRows(study),
      at = (name: string) => kColumns.indexOf(name as never)
    expect(rows).toHaveLength(1 + 2 * 23)
    expect(new Set(rows.map((row) => row.length))).toEqual(new Set([kColumns.length]))
    const real = rows.slice(1).filter((row) => row[at('kind')] === 'pair')
    expect(new Set(real.filter((row) => row[at('question')] === 'recorded').map((row) => row[at('correct')]))).toEqual(new Set([1]))
    expect(new Set(real.filter((row) => row[at('question')] === 'natural').map((row) => row[at('correct')]))).toEqual(new Set([0]))
    for (const row of real) expect(row[at('answer')] === row[at('side_of_capture')]).toBe(row[at('correct')] === 1)
    const caught = rows.slice(1).filter((row) => row[at('kind')] === 'catch')
    expect(caught).toHaveLength(6)
    expect(new Set(caught.map((row) => `${row[at('correct')]} ${row[at('method')]} ${row[at('side_of_capture')]}`))).toEqual(new Set([' captured both']))
    expect(csvOf(rows).split('\r\n')[1]).toContain('"P""1"""')
    expect(csvOf(rows)).toContain('"a, b"')
  })
  it('names the program version of each vote, or in older votes that of the setup', () => {
    const study = vote(vote(begin(studyOf(), 'P01', 'deaf'), answer({ version: 'signweave 0.3.0' })), answer())
    const rows = voteRows(study),
      at = kColumns.indexOf('software_version')
    expect(rows.slice(1).map((row) => row[at])).toEqual(['signweave 0.3.0', 'signweave 0.1.0'])
  })
  it('marks votes given after the results were opened', () => {
    const study = vote({ ...begin(studyOf(), 'P01', 'deaf'), unblinded: '2026-01-01T11:00:00Z' }, answer())
    expect(sessionOf(study)?.answers[0].unblinded).toBe(true)
  })
  it('summarizes by method, for everyone or one fluency', () => {
    let study = begin(studyOf({ rating: true }), 'P01', 'deaf')
    while (!isOver(study)) {
      const session = sessionOf(study)!,
        trial = session.trials[session.answers.length]
      const wrong = study.items[trial.item].method === 'gap'
      study = vote(study, answer({ recorded: wrong ? (trial.side === 'left' ? 'right' : 'left') : trial.side, rating: wrong ? 1 : 5, ms: 1000 }))
    }
    const all = outcomes(study)
    expect(all.map(({ method }) => method)).toEqual(['gap', 'learned', 'sine', ''])
    expect(all[0]).toMatchObject({ rating: 1, medianMs: 1000, share: { right: 0, value: 0, low: 0 } })
    expect(all[1].share?.value).toBe(1)
    expect(outcomes(study, 'learner')).toEqual([])
    expect(outcomes(study, 'deaf')).toEqual(all)
  })
  it('distinguishes captured and generated motion when shown alone', () => {
    let study = begin(studyOf({ mode: 'single', catches: 4 }), 'P01', 'deaf')
    expect(study.items).toHaveLength(20)
    while (!isOver(study)) study = vote(study, answer({ recorded: 'left', rating: 3 }))
    const all = outcomes(study)
    expect(all.map(({ method, share }) => [method, share?.value])).toEqual([
      ['captured', 1],
      ['gap', 0],
      ['learned', 0],
      ['sine', 0],
    ])
    expect(votesOf(study)).toHaveLength(20)
  })
  it('has custom labels, and the defaults otherwise', () => {
    const labels = labelsOf('single', { recorded: { en: ' Who? ' }, rating: { en: '', fr: 'Note' } })
    expect(labels.recorded).toEqual({ en: 'Who?', fr: defaultsOf('single').recorded.fr })
    expect(labels.rating).toEqual({ en: defaultsOf('single').rating.en, fr: 'Note' })
  })
})

describe("Wilson's interval", () => {
  it('matches published tables', () => {
    const { low, high, value } = wilson(8, 10)!
    expect([value, low, high].map((x) => x.toFixed(4))).toEqual(['0.8000', '0.4902', '0.9433'])
    expect(wilson(0, 20)!.low).toBe(0)
    expect(wilson(0, 20)!.high).toBeCloseTo(0.1611, 4)
    expect(wilson(20, 20)!.high).toBe(1)
    expect(wilson(0, 0)).toBeUndefined()
  })
})
