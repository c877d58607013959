import { describe, expect, it } from 'vitest'
import { blockOf, encode } from './encode'
import { decodeMessage, frameBytes, kMessageHeaderBytes, skeletonOf, type FramesHeader } from './frames'
import { rigOf, readFrames, type MotionHeader } from './frames_body'
import { FrameStore } from './frame_store'
import { restPose, type Pose } from './pose'
import type { Skeleton } from './skeleton'

const half = Math.SQRT1_2

const kSkeleton: Skeleton = {
  joints: [
    { name: 'root', parent: -1, offset: [0, 1, 0] },
    { name: 'hand', parent: 0, offset: [1, 0, 0] },
  ],
  translated: [0],
  tracks: ['jawOpen'],
}
const kHeader: FramesHeader = {
  ...kSkeleton,
  recording: 'r',
  declarations: [],
  rate: 10,
  layout: 1,
  frame_bytes: 32,
}
/** A root that moves and is rotated about y by 0, then 90 degrees, and a hand a metre to its left. */
function turn(): [Pose, Pose] {
  const a = restPose(kSkeleton),
    b = restPose(kSkeleton)
  b.positions[0] = 0.5
  b.rotations.set([0, half, 0, half])
  b.tracks[0] = 1
  return [a, b]
}

describe('the layout of frames', () => {
  it('has the bytes given in docs/stream.md', () => {
    expect(frameBytes(kSkeleton)).toBe(12 + 4 + 16)
    const view = new DataView(encode(kSkeleton, turn()), kMessageHeaderBytes)
    expect(view.getInt32(32, true)).toBe(50000) // half a metre in units of 10 µm, second frame
    expect(view.getFloat32(32 + 12, true)).toBe(1)
    expect(view.getInt16(32 + 16 + 2, true)).toBe(Math.round(half * 32767))
  })

  it('rejects messages whose length does not match their header', () => {
    const message = encode(kSkeleton, [restPose(kSkeleton)], 41)
    const view = new DataView(message)
    view.setUint32(4, 7, true)
    expect(decodeMessage(message, 32)).toMatchObject({ first: 41, count: 1, leftOut: 7, offset: 16 })
    view.setUint16(2, 2, true)
    expect(() => decodeMessage(message, 32)).toThrow('2 frames of 32 bytes')
    view.setUint8(0, 2)
    expect(() => decodeMessage(message, 32)).toThrow('layout 2')
  })

  it('rejects a header with frames of another length or layout', () => {
    expect(skeletonOf(kHeader)).toEqual(kSkeleton)
    expect(() => skeletonOf({ ...kHeader, frame_bytes: 36 })).toThrow('36 bytes')
    expect(() => skeletonOf({ ...kHeader, layout: 2 })).toThrow('layout 2')
  })
})

describe('frames in an answer', () => {
  const motionHeader: MotionHeader = {
    ...kHeader,
    frames: 3,
    origin_ms: 120,
    rig: { parts: { left_hand: { joint: 'hand', index: 1, evidence: 'name', confidence: 1 } } },
  }
  /** The bytes of an answer of two messages, in parts of `size` bytes. */
  function body(size: number, header = motionHeader, cut = 0): ReadableStream<Uint8Array> {
    const text = new TextEncoder().encode(JSON.stringify(header)),
      length = new Uint8Array(new Uint32Array([text.length]).buffer)
    const parts = [length, text, new Uint8Array(encode(kSkeleton, turn())), new Uint8Array(encode(kSkeleton, [turn()[0]], 2))]
    const all = parts.flatMap((part) => [...part])
    all.length -= cut
    return new ReadableStream({
      start(stream) {
        for (let at = 0; at < all.length; at += size) stream.enqueue(Uint8Array.from(all.slice(at, at + size)))
        stream.close()
      },
    })
  }
  async function read(stream: ReadableStream<Uint8Array>): Promise<FrameStore> {
    let store: FrameStore
    await readFrames(stream, {
      begin: (header) => (store = new FrameStore(skeletonOf(header), header.rate, rigOf(header), header.frames)),
      take: (block) => store.put(block),
    })
    return store!
  }

  it('are read in chunks of any size', async () => {
    for (const size of [1, 7, 50, 100_000]) {
      const store = await read(body(size))
      expect([store.arrived, store.length, store.hand(1, 0, 2)]).toEqual([3, 3, expect.closeTo(-1, 3)])
    }
  })

  it('are rejected if the answer ends early, continues, or has no header', async () => {
    await expect(read(body(64, motionHeader, 5))).rejects.toThrow('too early')
    await expect(read(body(64, { ...motionHeader, frames: 2 }))).rejects.toThrow('longer than')
    await expect(read(new ReadableStream({ start: (stream) => (stream.enqueue(Uint8Array.from([2, 0, 0, 0, 0x7b, 0x7b])), stream.close()) }))).rejects.toThrow(
      'not JSON',
    )
  })
})

describe('stored frames', () => {
  const store = () => {
    const made = new FrameStore(kSkeleton, 10, { left_hand: { joint: 1 } }, 400)
    made.put(blockOf(kSkeleton, turn(), 127)) // across the boundary of two pages
    return made
  }

  it('are interpolated, positions linearly and rotations along the shorter arc', () => {
    const made = store()
    const pose = restPose(made.skeleton)
    expect(made.sample(12.75, pose)).toBe(true)
    expect(pose.positions[0]).toBeCloseTo(0.25, 4)
    expect(pose.tracks[0]).toBeCloseTo(0.5, 4)
    expect(2 * Math.acos(pose.rotations[3])).toBeCloseTo(Math.PI / 4, 3)
    expect(Math.hypot(...pose.rotations.slice(0, 4))).toBeCloseTo(1, 6)
  })

  it('are not invented if none has arrived', () => {
    const made = store()
    const pose = restPose(made.skeleton)
    expect(made.sample(3, pose)).toBe(false)
    expect(made.sample(30, pose)).toBe(true) // the nearest earlier one
    expect(pose.positions[0]).toBeCloseTo(0.5, 4)
    expect([made.has(126), made.has(127), made.has(128), made.has(129)]).toEqual([false, true, true, false])
    expect([made.firstMissing(127), made.firstNew(127), made.arrived]).toEqual([129, 129, 2])
  })

  it('are dropped by whole pages, and their hand positions kept', () => {
    const made = store()
    made.forgetBefore(200)
    expect([made.has(127), made.has(128), made.held, made.arrived]).toEqual([false, true, 1, 2])
    expect(made.hand(127, 0, 0)).toBeCloseTo(1, 3)
    made.forgetBefore(256)
    expect([made.has(128), made.held, made.length]).toEqual([false, 0, 400])
    made.put(blockOf(kSkeleton, turn(), 127))
    expect([made.held, made.arrived]).toEqual([2, 2])
  })

  it('are kept around the current time if there are too many, and requested if they never arrived', () => {
    const made = new FrameStore(kSkeleton, 10, {}, 1000)
    for (let frame = 0; frame < 900; frame += 2) made.put(blockOf(kSkeleton, turn(), frame))
    expect([made.held, made.firstNew(950), made.firstMissing(0)]).toEqual([900, 950, 900])
    made.keepAround(500, 400)
    expect(made.held).toBeLessThanOrEqual(400)
    expect([made.has(384), made.has(500), made.has(639), made.has(0), made.has(899)]).toEqual([true, true, true, false, false])
    made.put(
      blockOf(
        kSkeleton,
        Array.from({ length: 100 }, () => turn()[0]),
        900,
      ),
    )
    expect([made.firstNew(500), made.arrived, made.firstMissing(0)]).toEqual([1000, 1000, 0])
  })

  it('give the position and speed of the hands', () => {
    const made = store()
    expect(made.hand(127, 0, 0)).toBeCloseTo(1, 3)
    expect(made.hand(128, 0, 2)).toBeCloseTo(-1, 3) // rotated by 90 degrees about y
    expect(made.hand(127, 1, 0)).toBeNaN()
    expect(made.speed(200, 0)).toBeNaN()
    expect(made.hasHand).toEqual([true, false])
  })
})
