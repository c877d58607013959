import { expect, it } from 'vitest'
import { blockOf } from '../../../motion/encode'
import { FrameStore } from '../../../motion/frame_store'
import { restPose } from '../../../motion/pose'
import type { Skeleton } from '../../../motion/skeleton'
import { Figure } from './figure'
import { measured, standOf } from './measures'

const kSkeleton: Skeleton = {
  joints: [
    { name: 'Hips', parent: -1, offset: [0, 1, 0] },
    { name: 'Head', parent: 0, offset: [0, 0.7, 0] },
    { name: 'LeftArm', parent: 0, offset: [0.2, 0.5, 0] },
    { name: 'RightArm', parent: 0, offset: [-0.2, 0.5, 0] },
    { name: 'LeftFoot', parent: 0, offset: [0.1, -1, 0] },
  ],
  translated: [0],
  tracks: [],
}
const kRig = { pelvis: { joint: 0 }, head: { joint: 1 }, left_upper_arm: { joint: 2 }, right_upper_arm: { joint: 3 } }

/** Measures frames with these rotations of the root (x y z w). */
function of(turns: readonly (readonly number[])[], swapped = false) {
  const poses = turns.map((turn) => {
    const pose = restPose(kSkeleton)
    pose.rotations.set(turn, 0)
    return pose
  })
  const store = new FrameStore(kSkeleton, 30, kRig, poses.length)
  store.put(blockOf(kSkeleton, poses))
  return measured(new Figure(kSkeleton, kRig, swapped), store)
}
const kUpright = [0, 0, 0, 1],
  kOnItsBack = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2]

it('measures the height of a body and that it is upright', () => {
  const { height, rise, least, most, across, sides, cloud } = of([kUpright, kUpright])
  expect(height).toBeCloseTo(1.7, 3)
  expect(rise).toBeCloseTo(1, 3)
  expect([least[1], most[1]].map((value) => Number(value.toFixed(3)))).toEqual([0, 1.7])
  expect(across?.map((value) => Number(value.toFixed(3)))).toEqual([1, 0])
  expect(sides[0]).toBeCloseTo(0.4, 3)
  expect(cloud.length).toBe(2 * 5 * 3)
})

it('detects a lying body, and measures its median height', () => {
  const { height, rise } = of([kOnItsBack, kUpright, kOnItsBack])
  expect(height).toBeLessThan(0.01)
  expect(rise).toBeCloseTo(1 / 3, 3)
  expect(standOf(of([kOnItsBack]).rise!)).toBe('lying')
})

it('determines sides by name, and the shoulders by the body', () => {
  const { sides, across } = of([kUpright], true)
  expect(sides[0]).toBeCloseTo(-0.4, 3)
  expect(across?.[0]).toBeCloseTo(1, 3)
})

it('gives no direction for shoulders that face everywhere', () => {
  expect(of([kUpright, [0, 1, 0, 0]]).across).toBeUndefined()
})

it('has texts for the postures', () => {
  expect([1, 0.8, 0.5, -0.2, -0.9].map(standOf)).toEqual(['upright', 'upright', 'lying', 'lying', 'upsideDown'])
})
