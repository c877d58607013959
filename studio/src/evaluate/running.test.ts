import { beforeEach, describe, expect, it, vi } from 'vitest'
import type { JobState } from '../api/types'
import type { Api } from '../api/client'
import { ApiError, StudioFault } from '../api/fault'
import type { Evaluation } from './evaluation'
import { Running } from './running.svelte'

const evaluation = { recordings: 1 } as Evaluation
type OnState = (state: JobState<Evaluation>) => void
const stored = new Map<string, string>()

/** A server whose answers are given one after the other; `result` ends when the test says so. */
function server() {
  const cancelled: string[] = [],
    waits: { onstate: OnState; resolve: (one: Evaluation) => void; reject: (fault: unknown) => void }[] = []
  let begin: (job: { job: string }) => void = () => {}
  const api = {
    evaluate: () => new Promise((resolve) => (begin = resolve)),
    result: (_: unknown, onstate: OnState) => new Promise((resolve, reject) => waits.push({ onstate, resolve, reject })),
    cancel: async (job: string) => {
      cancelled.push(job)
    },
  }
  return { api: api as unknown as Api & typeof api, cancelled, waits, answer: () => begin({ job: '7' }) }
}
const settle = async () => {
  for (let i = 0; i < 10; ++i) await Promise.resolve()
}
const state = (fraction: number) => ({ state: 'running', fraction }) as JobState<Evaluation>

beforeEach(() => {
  stored.clear()
  vi.stubGlobal('sessionStorage', { getItem: (key: string) => stored.get(key) ?? null, setItem: (key: string, value: string) => void stored.set(key, value) })
  vi.useFakeTimers()
  return () => {
    vi.useRealTimers()
    vi.unstubAllGlobals()
  }
})

describe('a running evaluation', () => {
  it("can be cancelled before the server has returned the job's id", async () => {
    const { api, cancelled, waits, answer } = server(),
      running = new Running(api, 'demo')
    void running.start({ method: [], seed: 1 })
    await running.cancel()
    expect(cancelled).toEqual([])
    answer()
    await settle()
    expect(cancelled).toEqual(['7'])
    waits[0].reject(new ApiError('cancelled', 500, 'cancelled'))
    await settle()
    expect([running.state, running.cancelled, running.fault]).toEqual(['idle', true, undefined])
    // The next job is not cancelled.
    void running.start({ method: [], seed: 1 })
    answer()
    await settle()
    expect(cancelled).toEqual(['7'])
  })
  it('is followed while the server is unreachable, automatically and on request', async () => {
    const { api, waits, answer } = server(),
      running = new Running(api, 'demo')
    void running.start({ method: [], seed: 1 })
    answer()
    await settle()
    waits[0].onstate(state(0.4))
    waits[0].reject(new StudioFault('unreachable'))
    await settle()
    expect([running.state, running.fraction, running.lost]).toEqual(['running', 0.4, true])
    await vi.advanceTimersByTimeAsync(1000)
    expect(waits).toHaveLength(2)
    waits[1].reject(new ApiError('bad gateway', 502, 'internal'))
    await settle()
    running.retry()
    await settle()
    expect(waits).toHaveLength(3)
    waits[2].onstate(state(0.9))
    expect([running.fault, running.lost, running.fraction]).toEqual([undefined, false, 0.9])
    waits[2].resolve(evaluation)
    await settle()
    expect([running.state, running.shown?.evaluation]).toEqual(['idle', evaluation])
    await vi.advanceTimersByTimeAsync(60_000)
    expect(waits).toHaveLength(3)
  })
  it('is cancelled once the server is reachable again', async () => {
    const { api, cancelled, waits, answer } = server(),
      running = new Running(api, 'demo')
    void running.start({ method: [], seed: 1 })
    answer()
    await settle()
    api.cancel = async () => {
      throw new StudioFault('unreachable')
    }
    await running.cancel()
    expect(running.lost).toBe(true)
    api.cancel = async (job) => {
      cancelled.push(job)
    }
    waits[0].onstate(state(0.5))
    waits[0].onstate(state(0.6))
    await settle()
    expect(cancelled).toEqual(['7'])
  })
  it('ends if the server says so, and silently if the server has forgotten it', async () => {
    stored.set('signweave.evaluation.demo', '3')
    const { api, waits, answer } = server(),
      running = new Running(api, 'demo')
    waits[0].reject(new ApiError('there is no job 3', 404, 'not_found'))
    await settle()
    expect([running.state, running.fault, stored.get('signweave.evaluation.demo')]).toEqual(['idle', undefined, ''])
    void running.start({ method: [], seed: 1 })
    answer()
    await settle()
    waits[1].reject(new ApiError('nothing is annotated', 500, 'bad_input'))
    await settle()
    expect([running.state, (running.fault as Error).message]).toEqual(['idle', 'nothing is annotated'])
  })
})
