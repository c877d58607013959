import { beforeEach, describe, expect, it, vi } from 'vitest'
import { defaultsOf } from './labels'
import { readStudy } from './read_study'
import { Shelf } from './store'
import { begin, itemsOf, keepDraft, kFormat, leave, sessionOf, vote, type Settings, type Source, type Study } from './study'

const settings: Settings = {
  seed: 7,
  mode: 'pair',
  methods: ['learned'],
  trials: 4,
  catches: 0,
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
const sources: readonly Source[] = Array.from({ length: 4 }, (_, i) => ({
  recording: 'a',
  from: 1000 * i,
  to: 1000 * i + 400,
  begin: 1000 * i,
  end: 1000 * i + 2400,
  signs: '',
}))
const made = (): Study => ({
  format: kFormat,
  database: 'demo',
  version: 'signweave 0.1.0',
  at: '2026-01-01T00:00:00Z',
  settings,
  items: itemsOf(sources, settings),
  sessions: [],
})
let second = 0
const answer = (comment = '') => ({
  recorded: 'left' as const,
  rating: 3,
  comment,
  plays: 2,
  ms: 3000,
  at: new Date(++second * 1000).toISOString(),
  version: 'signweave 0.2.0',
})
const votes = (study: Study | undefined) =>
  Object.fromEntries((study?.sessions ?? []).map(({ participant, answers }) => [participant, answers.map(({ comment }) => comment)]))

class Memory {
  readonly kept = new Map<string, string>()
  full = false
  getItem(key: string) {
    return this.kept.get(key) ?? null
  }
  setItem(key: string, value: string) {
    if (this.full) throw new Error('full')
    this.kept.set(key, value)
  }
  removeItem(key: string) {
    this.kept.delete(key)
  }
}
/** The storage shared by all tabs, and the storage of the current tab. */
let shared: Memory
const tabs = new Map<Shelf, Memory>()
const at = (shelf: Shelf) => {
  vi.stubGlobal('sessionStorage', tabs.get(shelf)!)
  return shelf
}
function tab(): Shelf {
  const shelf = new Shelf('demo')
  tabs.set(shelf, new Memory())
  return shelf
}
beforeEach(() => {
  vi.stubGlobal('localStorage', (shared = new Memory()))
  vi.stubGlobal('sessionStorage', new Memory())
  return () => vi.unstubAllGlobals()
})

describe('a study in several tabs', () => {
  it('keeps the votes of all tabs, and the current participant of each', () => {
    const one = tab(),
      two = tab()
    let a = at(one).write(begin(made(), 'P01', 'deaf'))
    expect(at(two).read().study?.current).toBeUndefined()
    let b = at(two).write(begin(two.read().study!, 'P02', 'learner'))
    a = at(one).write(vote(a, answer('a1')))
    b = at(two).write(vote(b, answer('b1')))
    a = at(one).write(vote(a, answer('a2')))
    b = at(two).write(keepDraft(b, { rating: 2 }))
    expect(votes(at(one).read().study)).toEqual({ P01: ['a1', 'a2'], P02: ['b1'] })
    expect([a.current, at(one).read().study?.current, at(two).read().study?.current]).toEqual(['P01', 'P01', 'P02'])
    // A tab notified later has the same, and its own session unchanged, so that the trial on screen continues.
    const heard = at(one).heard(a).study!
    expect(votes(heard)).toEqual(votes(b))
    expect(sessionOf(heard)).toBe(sessionOf(a))
  })
  it('counts one vote for a trial answered in both: the first', () => {
    const one = tab(),
      two = tab()
    const a = at(one).write(begin(made(), 'P01', 'deaf')),
      b = begin(at(two).read().study!, 'P01', 'none')
    at(one).write(vote(a, answer('first')))
    const both = at(two).write(vote(b, answer('second')))
    expect(votes(both)).toEqual({ P01: ['first'] })
    expect(both.sessions[0].fluency).toBe('deaf')
  })
  it('restores a vote that another tab overwrote', () => {
    const one = tab(),
      two = tab()
    const a = at(one).write(begin(made(), 'P01', 'deaf')),
      before = shared.getItem(one.key)!
    const voted = at(one).write(vote(a, answer('lost')))
    shared.setItem(one.key, before)
    expect(votes(at(one).heard(voted).study)).toEqual({ P01: ['lost'] })
    expect(votes(at(two).read().study)).toEqual({ P01: ['lost'] })
  })
  it('is unblinded, deleted or replaced for all', () => {
    const one = tab(),
      two = tab()
    const a = at(one).write(vote(begin(made(), 'P01', 'deaf'), answer('a')))
    at(two).write({ ...two.read().study!, unblinded: '2026-01-02T00:00:00Z' })
    const voted = at(one).write(vote(at(one).heard(a).study!, answer('b')))
    expect(voted.sessions[0].answers.map(({ unblinded }) => unblinded)).toEqual([false, true])
    at(two).remove()
    expect(at(one).heard(voted)).toEqual({})
    at(two).write({ ...made(), at: '2026-02-02T00:00:00Z' })
    expect(() => at(one).write(vote(voted, answer()))).toThrow('otherStudy')
    expect(at(one).heard(voted).study).toMatchObject({ at: '2026-02-02T00:00:00Z', sessions: [] })
    at(two).write(begin(two.read().study!, 'P01', 'none'))
    expect([at(one).read().study?.current, at(two).read().study?.current]).toEqual([undefined, 'P01'])
  })
})

describe('the stored text', () => {
  it('stays if it is unreadable, and is never overwritten', () => {
    const shelf = tab()
    shared.setItem(shelf.key, '{"format":"signweave study 9"}')
    expect(at(shelf).read()).toEqual({ unreadable: true })
    expect(shelf.raw()).toBe('{"format":"signweave study 9"}')
    expect(() => at(tab()).write(made())).toThrow('otherStudy')
    expect(shared.getItem(shelf.key)).toBe(shelf.raw())
    shelf.remove()
    expect(shelf.read()).toEqual({})
  })
  it('reports if nothing can be stored', () => {
    shared.full = true
    expect(() => at(tab()).write(made())).toThrow('noStorage')
    vi.unstubAllGlobals()
    expect(tab().read()).toEqual({})
  })
})

describe('a file of a study', () => {
  const good = keepDraft(vote(begin(made(), 'P01', 'deaf'), { ...answer(), at: '2026-01-01T10:00:00Z' }), { recorded: 'right', comment: 'x', plays: 1, ms: 10 })
  const with_ = (more: object) => JSON.stringify({ ...good, ...more })
  const session = (more: object) => with_({ sessions: [{ ...good.sessions[0], ...more }] })
  const setting = (more: object) => with_({ settings: { ...settings, ...more } })
  it('is read unchanged', () => {
    expect(readStudy(JSON.stringify(good))).toEqual(good)
    expect(readStudy(JSON.stringify(leave({ ...good, recordings: { a: 'x' }, leftOut: ['b'] })))).toBeTruthy()
  })
  it.each(
    Object.entries({
      'no methods': setting({ methods: undefined }),
      'a method that is none': setting({ methods: [1] }),
      'a method twice': setting({ methods: ['gap', 'gap'] }),
      'no order': setting({ order: undefined }),
      'nothing asked': setting({ recorded: false, rating: false, comment: false }),
      'no labels': setting({ labels: {} }),
      'endless around': setting({ around: null }),
      'somebody twice': with_({ sessions: [good.sessions[0], good.sessions[0]] }),
      nobody: session({ participant: '' }),
      'no answer': session({ answers: [null] }),
      'an odd answer': session({ answers: [{ ...good.sessions[0].answers[0], recorded: 'up' }] }),
      'an answer without a time': session({ answers: [{ ...good.sessions[0].answers[0], ms: null }] }),
      'a rating of nine': session({ draft: { rating: 9 } }),
      'a draft that is none': session({ draft: 'x' }),
      'a trial of nothing': session({ trials: [{ item: 'length', side: 'left' }] }),
      'a trial too far': session({ trials: [{ item: 4, side: 'left' }] }),
      'more answers than trials': session({ trials: [] }),
      'no items': with_({ items: [] }),
      'an item without signs': with_({ items: [{ ...good.items[0], signs: undefined }] }),
      'odd recordings': with_({ recordings: [1] }),
      'odd version': session({ answers: [{ ...good.sessions[0].answers[0], version: 3 }] }),
    }),
  )('is rejected with %s', (_, text) => {
    expect(() => readStudy(text)).toThrow('noStudy')
  })
})
