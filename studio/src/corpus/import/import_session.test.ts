import { afterEach, beforeEach, expect, it, vi } from 'vitest'
import type { Api } from '../../api/client'
import type { InspectedRecording } from '../../api/schema'
import { addedAnswer, inspectedAnswer } from '../../api/test_answers'
import { ApiError, StudioFault } from '../../api/fault'
import { kNone } from './corrections'
import { ImportSession } from './import_session.svelte'

type Body = Readonly<Record<string, unknown>> & { readonly recordings?: readonly string[] }
interface Call {
  readonly what: string
  readonly body: Body
  readonly answer: (result: unknown) => void
  readonly refuse: (fault: unknown) => void
}

const server = vi.hoisted(() => ({
  begun: [] as { what: string; body: object }[],
  discarded: [] as string[],
  cancelled: [] as string[],
  opened: 0,
  put: new Map<string, string>(),
  onbegin: undefined as (() => void) | undefined,
}))
vi.mock('../../api/corpus_calls', () => ({
  formats: () => Promise.resolve(['.bvh', '.eaf'].map((extension) => ({ extension, name: extension, reads: true, writes: true, holds: '' }))),
  isWritable: () => Promise.resolve(true),
  openUpload: () => Promise.resolve(`upload ${++server.opened}`),
  sendFile: async (_api: unknown, _database: string, _upload: string, name: string, file: Blob) => void server.put.set(name, await file.text()),
  discardUpload: (_api: unknown, _database: string, upload: string) => (server.discarded.push(upload), Promise.resolve()),
  cancelJob: (_api: unknown, job: string) => (server.cancelled.push(job), Promise.resolve()),
  removeUploaded: () => Promise.resolve(),
  beginUpload: (_api: unknown, _database: string, _upload: string, what: string, body: object) => {
    server.onbegin?.()
    return Promise.resolve({ job: String(server.begun.push({ what, body }) - 1) })
  },
}))

/** Calls waiting for an answer. */
let calls: Call[] = []
const result = ({ job }: { job: string }) => new Promise((answer, refuse) => calls.push({ ...server.begun[Number(job)], answer, refuse } as Call))
const api = { result } as unknown as Api
const report = (name: string, more: Partial<InspectedRecording> = {}) => inspectedAnswer({ name, ...more })
const kMirrored = { up: 'y', unit: 0.01, root_unit: 0.01, mirrored: true, root_order: 'declared' } as const
const inspection = (recordings: readonly InspectedRecording[]) => ({ recordings, notices: [], faults: [] })
const stored = (names: readonly string[]) => ({ recordings: names.map(addedAnswer), notices: [], faults: [] })
const corrected = (settings: object) => ({ ...kNone, settings })
/** Returns the next call; its parameters are those at the time of the call. */
async function next(): Promise<Call> {
  await vi.waitFor(() => expect(calls.length).toBeGreaterThan(0))
  return calls.shift()!
}
const settle = () => vi.advanceTimersByTimeAsync(1000)

/** Returns a session in which the recordings a, b and c were inspected. */
async function looked(): Promise<ImportSession> {
  const session = new ImportSession(api, 'db')
  await vi.waitFor(() => expect(session.writable).toBe(true))
  await session.add(['a', 'b', 'c'].map((name) => ({ file: new File(['x'], `${name}.bvh`), folder: '' })))
  const sent = session.send()
  ;(await next()).answer(inspection(['a', 'b', 'c'].map((name) => report(name))))
  await sent
  return session
}

beforeEach(() => void vi.useFakeTimers({ shouldAdvanceTime: true }))
afterEach(() => {
  vi.useRealTimers()
  calls = []
  Object.assign(server, { begun: [], discarded: [], cancelled: [], opened: 0, onbegin: undefined })
})

it('inspects again what is corrected during an inspection, and imports nothing without inspection', async () => {
  const session = await looked()
  session.correct('a.bvh', corrected({ unit: 'm' }))
  await settle()
  const first = await next()
  session.correct('b.bvh', corrected({ mirror: 'yes' }))
  session.correct('a.bvh', corrected({ unit: 'cm' }))
  first.answer(inspection([report('a')]))
  await vi.waitFor(() => expect(session.doing).toBeUndefined())
  expect([...session.stale].sort()).toEqual(['a.bvh', 'b.bvh'])
  await settle()
  const second = await next()
  expect(second.body).toEqual({ unit: 'cm', recordings: ['a'] })
  second.answer(inspection([report('a')]))
  const third = await next()
  expect(third.body).toEqual({ mirror: true, recordings: ['b'] })
  third.answer(inspection([report('b', { layout: kMirrored })]))
  await vi.waitFor(() => expect(session.stale.size).toBe(0))
  expect(session.reports.find(({ name }) => name === 'b')!.layout!.mirrored).toBe(true)
})

it('keeps corrections made during a full inspection', async () => {
  const session = await looked(),
    again = session.send(),
    all = await next()
  session.correct('c.bvh', corrected({ mirror: 'yes' }))
  all.answer(inspection(['a', 'b', 'c'].map((name) => report(name))))
  for (let left = 2; left > 0; --left) {
    const { body, answer } = await next()
    expect(body.mirror).toBe(body.recordings!.includes('c') || undefined)
    expect(session.stale.has('c.bvh')).toBe(true)
    answer(inspection(body.recordings!.map((name) => report(name))))
  }
  await again
  expect(session.stale.size).toBe(0)
})

it('keeps the report of a recording that is unreadable with its corrections', async () => {
  const session = await looked()
  session.correct('a.bvh', { ...kNone, rig: { pelvis: 'nope' } })
  await settle()
  const { answer } = await next()
  expect(server.put.get('parts.rig')).toBe('pelvis = nope\n')
  answer(inspection([report('a', { error: 'no joint nope' })]))
  await vi.waitFor(() => expect(session.refused.get('a.bvh')).toBe('no joint nope'))
  expect(session.reports.find(({ name }) => name === 'a')!.error).toBeUndefined()
  expect(session.wanted.map(({ name }) => name)).toEqual(['b', 'c'])
  // The next correction, of any recording, inspects it again; once fixed, it is like the others.
  session.correct('a.bvh', kNone)
  await settle()
  ;(await next()).answer(inspection([report('a')]))
  await vi.waitFor(() => expect(session.refused.size).toBe(0))
  expect(session.wanted).toHaveLength(3)
})

it("treats only the server's faults of corrections as such, and inspects the rest again", async () => {
  const session = await looked()
  session.correct('a.bvh', corrected({ face_timecode: '99:99:99:99' }))
  await settle()
  ;(await next()).refuse(new ApiError('no such timecode', 400, 'bad_input'))
  await vi.waitFor(() => expect(session.refused.size).toBe(1))
  expect(session.stale.size).toBe(0)
  // A refused recording is inspected again with the next correction, too.
  session.correct('b.bvh', corrected({ unit: 'm' }))
  expect([...session.stale].sort()).toEqual(['a.bvh', 'b.bvh'])
  for (const fault of [new StudioFault('unreachable'), new ApiError('stopping', 503, 'stopping'), new ApiError('disk full', 500, 'io')]) {
    if (session.fault) session.retry!()
    else await settle()
    ;(await next()).refuse(fault)
    await vi.waitFor(() => expect(session.fault).toBe(fault))
    expect([...session.stale].sort()).toEqual(['a.bvh', 'b.bvh'])
    expect(session.unlooked).toHaveLength(2)
  }
  session.retry!()
  for (const name of ['a', 'b']) (await next()).answer(inspection([report(name)]))
  await vi.waitFor(() => expect(session.stale.size).toBe(0))
  expect([session.refused.size, session.fault]).toEqual([0, undefined])
})

it('imports the others if one is refused, and retries the failed one', async () => {
  const session = await looked()
  session.correct('a.bvh', corrected({ unit: 'm' }))
  session.correct('b.bvh', corrected({ unit: 'cm' }))
  await settle()
  for (const name of ['a', 'b']) (await next()).answer(inspection([report(name)]))
  await vi.waitFor(() => expect(session.stale.size).toBe(0))
  const over = session.import(),
    first = await next()
  expect(first.body.recordings).toEqual(['a'])
  first.refuse(new ApiError('not so', 400, 'bad_input'))
  const away = new StudioFault('unreachable')
  ;(await next()).answer(stored(['b']))
  ;(await next()).refuse(away)
  await over
  expect(session.outcomes.get('a.bvh')).toMatchObject({ outcome: 'failed', error: 'not so' })
  expect([session.fault, session.wanted.map(({ name }) => name)]).toEqual([away, ['a', 'c']])
  // A recording corrected since is not imported before it is inspected.
  session.correct('c.bvh', kNone)
  session.retry!()
  const again = await next()
  expect(again.body.recordings).toEqual(['a'])
  again.answer(stored(['a']))
  await vi.waitFor(() => expect([session.doing, session.wanted.map(({ name }) => name)]).toEqual([undefined, ['c']]))
  await settle()
  ;(await next()).answer(inspection([report('c')]))
  await vi.waitFor(() => expect(session.stale.size).toBe(0))
  const rest = session.import()
  ;(await next()).answer(stored(['c']))
  await rest
  expect([server.begun.at(-1), session.wanted.length]).toEqual([{ what: 'import', body: { recordings: ['c'] } }, 0])
})

it('does not mark a recording corrected during its import as imported', async () => {
  const session = await looked()
  session.correct('c.bvh', corrected({ unit: 'm' }))
  await settle()
  ;(await next()).answer(inspection([report('c')]))
  await vi.waitFor(() => expect(session.stale.size).toBe(0))
  const over = session.import(),
    first = await next()
  session.correct('a.bvh', corrected({ mirror: 'yes' }))
  session.correct('c.bvh', corrected({ unit: 'cm' }))
  first.answer(stored(['a', 'b']))
  await over
  expect([...session.outcomes.keys()]).toEqual(['b.bvh'])
  expect(session.wanted.map(({ name }) => name)).toEqual(['a', 'c'])
  expect(server.begun.filter(({ what }) => what === 'import')).toHaveLength(1)
})

it('rejects adding and removing files during a job, with a message', async () => {
  const session = await looked(),
    over = session.import(),
    { answer } = await next()
  await session.add([{ file: new File(['x'], 'd.bvh'), folder: '' }])
  session.remove([1])
  expect([session.turnedAway, session.list.files.length, session.reports.length, session.doing?.what]).toEqual([true, 3, 3, 'import'])
  answer(stored(['a', 'b', 'c']))
  await over
  expect(session.outcomes.size).toBe(3)
  await session.add([{ file: new File(['x'], 'd.bvh'), folder: '' }])
  expect([session.turnedAway, session.list.files.length]).toEqual([false, 1])
})

it('discards an unused upload, and sends it again when needed', async () => {
  const session = await looked()
  session.leave()
  expect(server.discarded).toEqual([])
  session.want(['c.bvh'], false)
  const over = session.import(),
    { answer } = await next()
  session.close()
  expect(server.discarded).toEqual([])
  answer(stored(['a', 'b']))
  await over
  session.leave()
  expect(server.discarded).toEqual(['upload 1'])
  session.want(['c.bvh'], true)
  const rest = session.import(),
    second = await next()
  expect([server.opened, second.body.recordings]).toEqual([2, ['c']])
  second.answer(stored(['c']))
  await rest
  expect(session.wanted).toHaveLength(0)
  session.close()
  expect(server.discarded).toEqual(['upload 1', 'upload 2'])
})

it('lists the recordings without inspection after cancelling', async () => {
  const session = await looked()
  session.correct('a.bvh', corrected({ unit: 'm' }))
  expect(session.unlooked).toEqual([])
  await settle()
  ;(await next()).refuse(new ApiError('cancelled', 500, 'cancelled'))
  await vi.waitFor(() => expect(session.unlooked).toEqual(['a.bvh']))
  expect(session.fault).toBeUndefined()
  // A job can also be cancelled when it is about to start, or not known to have started.
  const again = session.inspect(session.unlooked)
  session.cancel()
  await again
  expect([server.begun.length, session.unlooked]).toEqual([2, ['a.bvh']])
  server.onbegin = () => session.cancel()
  const third = session.inspect(session.unlooked)
  ;(await next()).refuse(new ApiError('cancelled', 500, 'cancelled'))
  await third
  expect([server.cancelled, session.unlooked]).toEqual([['2'], ['a.bvh']])
})
