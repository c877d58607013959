import { expect, it, vi } from 'vitest'
import { blockOf } from '../../../motion/encode'
import { FrameStore } from '../../../motion/frame_store'
import { restPose } from '../../../motion/pose'
import type { OpenedMotion } from '../../../motion/source'
import { keyOf, Previews, type Reading } from './previews.svelte'

const kSkeleton = { joints: [{ name: 'Hips', parent: -1, offset: [0, 1, 0] as const }], translated: [0], tracks: [] }
function motion(): OpenedMotion {
  const store = new FrameStore(kSkeleton, 30, {}, 1)
  store.put(blockOf(kSkeleton, [restPose(kSkeleton)]))
  return { store, rig: {}, originMs: 0, declarations: {} }
}
/** Previews that are answered when the test says so. */
function asked() {
  const calls: { reading: Reading; signal: AbortSignal; give: (motion: OpenedMotion) => void; fail: (fault: unknown) => void }[] = []
  const previews = new Previews((reading, signal) => new Promise((give, fail) => calls.push({ reading, signal, give, fail })))
  return { previews, calls, readings: () => calls.map(({ reading }) => reading) }
}
const kZ = { up: 'z' },
  kMetres = { unit: 'm' }

it('requests one after the other, each once', async () => {
  const { previews, calls, readings } = asked()
  previews.want([{}, kZ])
  previews.want([{}, kZ])
  expect(readings()).toEqual([{}])
  calls[0].give(motion())
  await vi.waitFor(() => expect(readings()).toEqual([{}, kZ]))
  calls[1].give(motion())
  await vi.waitFor(() => expect(previews.get({ up: 'z' })?.drawn?.measures.most[1]).toBeCloseTo(1, 4))
  previews.want([{}, kZ])
  expect(calls.length).toBe(2)
})

it('cancels previews that are no longer wanted, and ignores their results', async () => {
  const { previews, calls, readings } = asked()
  previews.want([kZ])
  previews.want([kMetres])
  expect(calls[0].signal.aborted).toBe(true)
  expect(readings()).toEqual([kZ, kMetres])
  calls[0].give(motion())
  calls[1].give(motion())
  await vi.waitFor(() => expect(previews.get(kMetres)?.drawn).toBeDefined())
  expect(previews.get(kZ)).toBeUndefined()
})

it('keeps a fault as long as its preview is wanted, and retries on request', async () => {
  const { previews, calls } = asked()
  previews.want([kZ])
  calls[0].fail(new Error('no'))
  await vi.waitFor(() => expect(previews.get(kZ)?.fault).toBeInstanceOf(Error))
  previews.want([kZ])
  expect(calls.length).toBe(1)
  previews.retry(kZ)
  expect(calls.length).toBe(2)
  calls[1].fail(new Error('no'))
  await vi.waitFor(() => expect(previews.get(kZ)?.fault).toBeInstanceOf(Error))
  previews.want([])
  expect(previews.get(kZ)).toBeUndefined()
})

it('identifies a reading by its content, in any order', () => {
  expect(keyOf({ up: 'z', unit: 'm' })).toBe(keyOf({ unit: 'm', up: 'z' }))
  expect(keyOf({})).not.toBe(keyOf(kZ))
})
