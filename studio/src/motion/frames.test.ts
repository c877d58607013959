import { describe, expect, it } from 'vitest'
import { decodeMessage, encodeJson, frameBytes, kMessageHeaderBytes, skeletonOfJson, type MotionJson } from './frames'
import { FrameStore } from './frame_store'
import { restPose } from './pose'

const half = Math.SQRT1_2

/** A root that moves and turns about y by 0, then 90 degrees, and a hand a metre to its left. */
export const kTurn: MotionJson = {
  frames: 2, frames_per_second: 10,
  joints: [{ name: 'root', parent: -1, offset: [0, 1, 0], translated: true }, { name: 'hand', parent: 0, offset: [1, 0, 0], translated: false }],
  rotations_xyzw: [[0, 0, 0, 1, 0, 0, 0, 1], [0, half, 0, half, 0, 0, 0, 1]],
  translations_m: [[0, 1, 0], [0.5, 1, 0]],
  tracks: { jawOpen: [0, 1] },
}

describe('the layout of frames', () => {
  it('has the bytes that docs/stream.md says', () => {
    const skeleton = skeletonOfJson(kTurn)
    expect(frameBytes(skeleton)).toBe(12 + 4 + 16)
    const view = new DataView(encodeJson(kTurn, skeleton, 0).buffer)
    expect(view.getInt32(32, true)).toBe(50000) // half a metre in units of 10 µm, second frame
    expect(view.getFloat32(32 + 12, true)).toBe(1)
    expect(view.getInt16(32 + 16 + 2, true)).toBe(Math.round(half * 32767))
  })

  it('refuses messages that are not as long as they say', () => {
    const message = new ArrayBuffer(kMessageHeaderBytes + 32)
    const view = new DataView(message)
    view.setUint8(0, 1)
    view.setUint16(2, 1, true)
    view.setUint32(4, 7, true)
    view.setBigUint64(8, 41n, true)
    expect(decodeMessage(message, 32)).toMatchObject({ first: 41, count: 1, leftOut: 7, offset: 16 })
    view.setUint16(2, 2, true)
    expect(() => decodeMessage(message, 32)).toThrow('2 frames of 32 bytes')
    view.setUint8(0, 2)
    expect(() => decodeMessage(message, 32)).toThrow('layout 2')
  })

  it('refuses a motion whose numbers do not fit its skeleton', () => {
    const broken = { ...kTurn, rotations_xyzw: [kTurn.rotations_xyzw[0], [0, 0, 0, 1]] }
    expect(() => encodeJson(broken, skeletonOfJson(kTurn), 0)).toThrow('frame 1')
  })
})

describe('frames that have come', () => {
  const store = () => {
    const skeleton = skeletonOfJson(kTurn)
    const made = new FrameStore(skeleton, 10, { left_hand: { joint: 1 } }, 400)
    made.put(encodeJson(kTurn, skeleton, 127)) // over the bound of two pages
    return made
  }

  it('are blended between, places in a line and rotations the short way', () => {
    const made = store()
    const pose = restPose(made.skeleton)
    expect(made.sample(12.75, pose)).toBe(true)
    expect(pose.positions[0]).toBeCloseTo(0.25, 4)
    expect(pose.tracks[0]).toBeCloseTo(0.5, 4)
    expect(2 * Math.acos(pose.rotations[3])).toBeCloseTo(Math.PI / 4, 3)
    expect(Math.hypot(...pose.rotations.slice(0, 4))).toBeCloseTo(1, 6)
  })

  it('are not invented where none has come', () => {
    const made = store()
    const pose = restPose(made.skeleton)
    expect(made.sample(3, pose)).toBe(false)
    expect(made.sample(30, pose)).toBe(true) // the nearest earlier one
    expect(pose.positions[0]).toBeCloseTo(0.5, 4)
    expect([made.has(126), made.has(127), made.has(128), made.has(129)]).toEqual([false, true, true, false])
    expect(made.firstMissing(127)).toBe(129)
    expect(made.arrived).toBe(2)
  })

  it('are given up by whole pages, and counted', () => {
    const made = store()
    made.forgetBefore(200)
    expect([made.has(127), made.has(128), made.arrived]).toEqual([false, true, 1])
    made.forgetBefore(256)
    expect([made.has(128), made.arrived, made.length]).toEqual([false, 0, 400])
  })

  it('tell where the hand is and how fast', () => {
    const made = store()
    expect(made.hand(127, 0, 0)).toBeCloseTo(1, 3)
    expect(made.hand(128, 0, 2)).toBeCloseTo(-1, 3) // turned by 90 degrees about y
    expect(made.hand(127, 1, 0)).toBeNaN()
    expect(made.speed(200, 0)).toBeNaN()
    expect(made.hasHand).toEqual([true, false])
  })
})
