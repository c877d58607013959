import { describe, expect, it } from 'vitest'
import { parseRoute } from '../ui/route'
import { begin, finish, goTo, isOver, looked, readProgress, stepAt, type Progress } from './progress'
import { kSteps, type Facts } from './steps'
import { messages } from './messages'

const about = { database: 'demo', recording: 'meteo', gloss: 'MATIN' }
const facts = (hash: string, more: Partial<Facts> = {}): Facts => ({
  route: parseRoute(hash),
  playing: false,
  speed: 1,
  selected: false,
  calls: [],
  recordings: 2,
  recordingsBefore: 2,
  ...more,
})
const call = (method: string, where: string, body = '') => ({ method, where, body })

describe('a guided path', () => {
  it('advances when a step has just been done', () => {
    let progress = looked(begin('demo', about), facts('#/demo/guide'))
    expect([progress.step, progress.met, progress.before]).toEqual([0, false, 2])
    expect(looked(progress, facts('#/demo/guide'))).toBe(progress)
    progress = looked(progress, facts('#/demo/recording/meteo'))
    expect([progress.step, progress.done, progress.met]).toEqual([1, ['open'], undefined])
  })
  it('waits if a step was done before it began', () => {
    const progress = looked(begin('demo', about), facts('#/demo/recording/meteo'))
    expect([progress.step, progress.done, progress.met]).toEqual([0, ['open'], true])
    expect(looked(progress, facts('#/demo/recording/meteo'))).toBe(progress)
    expect(finish(progress).step).toBe(1)
  })
  it('detects new recordings from their number', () => {
    const at = kSteps.own.findIndex(({ id }) => id === 'store')
    let progress = looked(goTo(begin('own', about), at), facts('#/mine/import', { recordings: 0 }))
    progress = readProgress(JSON.stringify(progress))!
    expect(looked(progress, facts('#/mine', { recordings: 3 })).step).toBe(at + 1)
  })
  it('ends, and goes back', () => {
    let progress: Progress = begin('own', about)
    for (let i = 0; i < 20; ++i) progress = finish(progress)
    expect(isOver(progress)).toBe(true)
    expect(stepAt(progress)).toBeUndefined()
    expect(progress.done).toHaveLength(kSteps.own.length)
    expect(looked(progress, facts('#/demo'))).toBe(progress)
    expect(goTo(progress, -3).step).toBe(0)
  })
  it('is stored, and rejects anything else', () => {
    const progress = finish(begin('demo', about))
    expect(readProgress(JSON.stringify({ ...progress, met: true }))).toEqual(progress)
    const waiting = looked(progress, facts('#/demo'))
    expect(readProgress(JSON.stringify(waiting))).toEqual({ ...progress, met: false, before: 2 })
    for (const wrong of [null, '', '{}', 'null', '{"path":"x"}', JSON.stringify({ ...progress, step: 'a' })]) expect(readProgress(wrong)).toBeUndefined()
  })
  it('has texts for every step in both languages', () => {
    for (const step of [...kSteps.demo, ...kSteps.own]) {
      for (const language of ['en', 'fr'] as const) expect(messages[language].steps[step.id as never], `${language} ${step.id}`).toBeTruthy()
    }
  })
})

describe('steps', () => {
  const met = (path: 'demo' | 'own', id: string, now: Facts) => kSteps[path].find((step) => step.id === id)!.done!(now)
  it('are recognised from the player', () => {
    expect(met('demo', 'slow', facts('#/demo/recording/meteo', { playing: true, speed: 1 }))).toBe(false)
    expect(met('demo', 'slow', facts('#/demo/recording/meteo', { playing: true, speed: 0.5 }))).toBe(true)
    expect(met('demo', 'slow', facts('#/demo/compose', { playing: true, speed: 0.5 }))).toBe(false)
    expect(met('demo', 'select', facts('#/demo/recording/meteo', { selected: true }))).toBe(true)
  })
  it('are recognised from the address', () => {
    expect(met('demo', 'search', facts('#/demo/search'))).toBe(false)
    expect(met('demo', 'search', facts('#/demo/search?q=gloss'))).toBe(true)
    expect(met('demo', 'grid', facts('#/demo/search?q=gloss&view=table'))).toBe(false)
    expect(met('demo', 'grid', facts('#/demo/search?q=gloss&view=grid'))).toBe(true)
    expect(met('demo', 'compose', facts('#/demo/compose?utterance=VANNES'))).toBe(false)
    expect(met('demo', 'compose', facts('#/demo/compose?utterance=VANNES+MATIN'))).toBe(true)
    expect(met('demo', 'token', facts('#/demo/compose?utterance=VANNES+MATIN'))).toBe(false)
    expect(met('demo', 'token', facts('#/demo/compose?utterance=VANNES+MATIN%232'))).toBe(true)
    expect(met('demo', 'transition', facts('#/demo/compose?utterance=A+B&junctions=1%3Dgap'))).toBe(true)
    expect(met('demo', 'transition', facts('#/demo/compose?utterance=A+B'))).toBe(false)
  })
  it('are recognised from answered calls', () => {
    const on = (...calls: ReturnType<typeof call>[]) => facts('#/demo/compose?utterance=A', { calls })
    expect(met('demo', 'save', on(call('POST', 'databases/demo/sign', '{"utterance":"A","format":"frames"}')))).toBe(false)
    expect(met('demo', 'save', on(call('POST', 'databases/demo/sign', '{"utterance":"A"}')))).toBe(false)
    expect(met('demo', 'save', on(call('POST', 'databases/demo/sign', '{"utterance":"A","format":"bvh"}')))).toBe(true)
    expect(met('own', 'export', on(call('GET', 'databases/demo/recordings/a/motion?format=glb&from=1')))).toBe(true)
    expect(met('own', 'export', on(call('GET', 'databases/demo/recordings/a/motion?format=frames&from=1')))).toBe(false)
    expect(met('own', 'drop', facts('#/mine/import', { calls: [call('POST', 'databases/mine/uploads/7/inspect')] }))).toBe(true)
    expect(met('own', 'drop', facts('#/mine/import', { calls: [call('POST', 'databases/mine/uploads')] }))).toBe(false)
    expect(met('own', 'store', facts('#/mine/import', { recordings: 3, recordingsBefore: 0 }))).toBe(true)
    expect(met('own', 'propose', facts('#/mine/phases/ISL%20Thanks', { calls: [call('GET', 'databases/mine/recordings/x/segment')] }))).toBe(true)
    expect(met('own', 'check', facts('#/mine/phases/x', { calls: [call('POST', 'databases/mine/uploads/8/import')] }))).toBe(true)
    expect(met('demo', 'evaluate', facts('#/demo/evaluate', { calls: [call('POST', 'databases/demo/evaluate')] }))).toBe(true)
    expect(met('demo', 'evaluate', facts('#/demo/evaluate'))).toBe(false)
  })
})
