import { PerspectiveCamera, Vector3 } from 'three'
import { describe, expect, it } from 'vitest'
import { blockOf } from '../motion/encode'
import { FrameStore } from '../motion/frame_store'
import { restPose } from '../motion/pose'
import type { Rig, Skeleton } from '../motion/skeleton'
import { Proportions } from '../viewer/proportions'
import { Framing, largestAround, softened, windowOf, type Axes } from './framing'
import { follow, handPoints } from './landmarks'
import { sightsOf } from './sight'

const kAxes: Axes = { right: new Vector3(1, 0, 0), up: new Vector3(0, 1, 0), back: new Vector3(0, 0, 1) }
const kLens = 28,
  kWidth = 1280,
  kHeight = 720,
  kFoot = 40

/** Returns a pseudorandom number from 0 to 1 for each index. */
function chance(i: number): number {
  const x = Math.sin(i * 12.9898) * 43758.5453
  return x - Math.floor(x)
}

describe('a framing', () => {
  const window = windowOf(kLens, kWidth, kHeight, kFoot)
  const places = Float32Array.from({ length: 3 * 200 }, (_, i) => 2 * chance(i) - 1)
  const used = (stand: { right: number; up: number; back: number }, from = 0, to = 200) => {
    let most = 0
    for (let i = from; i < to; ++i) {
      const depth = stand.back - places[3 * i + 2],
        x = places[3 * i] - stand.right,
        y = places[3 * i + 1] - stand.up
      most = Math.max(most, Math.abs(x) / (window.side * depth), y / (window.top * depth), -y / (window.bottom * depth))
    }
    return most
  }

  it('contains every point, as close as possible', () => {
    const stand = new Framing(kAxes, window).still({ points: 200, places }, 0)
    expect(used(stand)).toBeCloseTo(1, 5)
    expect(used({ ...stand, back: stand.back - 0.01 })).toBeGreaterThan(1)
    for (const [right, up] of [
      [0.05, 0],
      [-0.05, 0],
      [0, 0.05],
      [0, -0.05],
    ]) {
      expect(used({ right: stand.right + right, up: stand.up + up, back: stand.back })).toBeGreaterThanOrEqual(1 - 1e-6)
    }
  })

  it('that moves contains the points of each frame, and follows smoothly', () => {
    const stands = new Framing(kAxes, window).moving({ points: 2, places }, 0, 5)
    expect(stands).toHaveLength(100)
    stands.forEach((stand, frame) => expect(used(stand, 2 * frame, 2 * frame + 2)).toBeLessThanOrEqual(1 + 1e-6))
    const jumps = stands.slice(1).map(({ right }, i) => Math.abs(right - stands[i].right))
    const unheld = new Framing(kAxes, window).moving({ points: 2, places }, 0, 0)
    expect(Math.max(...jumps)).toBeLessThan(Math.max(...unheld.slice(1).map(({ right }, i) => Math.abs(right - unheld[i].right))) / 3)
  })

  it('smooths by the mean and by the surrounding maximum', () => {
    expect(softened([0, 3, 6, 0], 1)).toEqual([1.5, 3, 3, 3])
    expect(largestAround([0, 3, 6, 0], 1)).toEqual([3, 6, 6, 6])
  })
})

describe('a sight', () => {
  const kSkeleton: Skeleton = {
    joints: [
      { name: 'hips', parent: -1, offset: [0, 1, 0] },
      { name: 'head', parent: 0, offset: [0, 0.6, 0] },
      { name: 'l', parent: 0, offset: [0.2, 0.4, 0] },
      { name: 'lh', parent: 2, offset: [0.5, 0, 0] },
      { name: 'r', parent: 0, offset: [-0.2, 0.4, 0] },
      { name: 'rh', parent: 4, offset: [-0.5, 0, 0] },
    ],
    translated: [0],
    tracks: [],
  }
  const kRig: Rig = {
    pelvis: { joint: 0 },
    head: { joint: 1 },
    neck: { joint: 1 },
    left_upper_arm: { joint: 2 },
    right_upper_arm: { joint: 4 },
    left_hand: { joint: 3 },
    right_hand: { joint: 5 },
    left_index_tip: { joint: 3, offset: [0.18, 0, 0] },
    right_index_tip: { joint: 5, offset: [-0.18, 0, 0] },
  }
  const store = new FrameStore(kSkeleton, 50, kRig)
  store.put(
    blockOf(
      kSkeleton,
      Array.from({ length: 120 }, (_, frame) => {
        const pose = restPose(kSkeleton)
        for (const [joint, side] of [
          [2, 1],
          [4, -1],
        ]) {
          const turn = side * (frame < 20 ? -0.75 : 1.1 * Math.sin(frame / 9 + joint))
          pose.rotations.set([0, side * 0.3 * Math.sin(frame / 7), Math.sin(turn), Math.cos(turn)], 4 * joint)
        }
        return pose
      }),
    ),
  )
  const motion = { store, rig: kRig, originMs: 0, declarations: {} }
  const signer = new Proportions(kSkeleton, kRig)
  const seen = (camera: PerspectiveCamera, marks: { points: number; places: Float32Array }, frame: number) =>
    Array.from({ length: marks.points }, (_, i) => new Vector3().fromArray(marks.places, 3 * (frame * marks.points + i)).project(camera))

  it.each(['front', 'side', 'hands'] as const)('from %s has the hands in the picture in every frame, above the caption', (view) => {
    const sights = sightsOf(motion, signer, view, (shots) => ({ lens: kLens, width: kWidth / shots, height: kHeight, foot: kFoot }))
    expect(sights).toHaveLength(view === 'hands' ? 2 : 1)
    for (const side of ['right', 'left'] as const) {
      const marks = follow(motion, handPoints(motion, side)),
        sight = sights[view === 'hands' && side === 'left' ? 1 : 0]
      expect(marks.points).toBe(2)
      let widest = 0
      for (let frame = 0; frame < store.length; ++frame) {
        for (const { x, y } of seen(sight.at(frame / store.rate), marks, frame)) {
          expect(Math.abs(x)).toBeLessThan(1)
          expect(y).toBeLessThan(1)
          expect(y).toBeGreaterThan(-1 + (2 * kFoot) / kHeight)
          widest = Math.max(widest, Math.abs(x), Math.abs(y))
        }
      }
      expect(widest).toBeGreaterThan(0.15)
    }
  })

  it('from the front centres the body, and does not move', () => {
    const [sight] = sightsOf(motion, signer, 'front', () => ({ lens: kLens, width: kWidth, height: kHeight, foot: kFoot }))
    expect(new Vector3(0, 1, 0).project(sight.at(0)).x).toBeCloseTo(0, 5)
    expect(sight.at(0).position.clone()).toEqual(sight.at(2).position.clone())
  })

  it('of unknown hands is rejected', () => {
    const { left_hand, right_hand, ...rig } = kRig
    expect(() => sightsOf({ ...motion, rig }, signer, 'hands', () => ({ lens: kLens, width: 1, height: 1, foot: 0 }))).toThrow('no hands')
    expect(left_hand && right_hand).toBeTruthy()
  })
})
