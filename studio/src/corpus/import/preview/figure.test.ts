import { expect, it } from 'vitest'
import { restPose } from '../../../motion/pose'
import type { Skeleton } from '../../../motion/skeleton'
import { Figure } from './figure'

const kSkeleton: Skeleton = {
  joints: [
    { name: 'Reference', parent: -1, offset: [0, 0, 0] },
    { name: 'Hips', parent: 0, offset: [0, 1, 0] },
    { name: 'Head', parent: 1, offset: [0, 0.6, 0] },
    { name: 'LeftHand', parent: 1, offset: [0.5, 0.3, 0] },
    { name: 'LeftThumb', parent: 3, offset: [0.1, 0, 0] },
    { name: 'RightHand', parent: 1, offset: [-0.5, 0.3, 0] },
  ],
  translated: [0],
  tracks: [],
}
const kRig = {
  pelvis: { joint: 1 },
  head: { joint: 2 },
  head_top: { joint: 2, offset: [0, 0.2, 0] as const },
  left_hand: { joint: 3 },
  right_hand: { joint: 5 },
}

it('has one line per bone, and none to joints above the pelvis', () => {
  const { lines, shown, head } = new Figure(kSkeleton, kRig)
  expect(lines.map(({ from, to, side, thin }) => [from, to, side, thin])).toEqual([
    [1, 2, 'middle', false],
    [1, 3, 'left', false],
    [3, 4, 'left', true],
    [1, 5, 'right', false],
    [2, 6, 'middle', false],
  ])
  expect(shown).toEqual([1, 2, 3, 4, 5, 6])
  expect(head).toEqual({ from: 2, to: 6 })
})

it('is drawn uniformly if the rig is unknown', () => {
  const { lines, shown, head } = new Figure(kSkeleton, {})
  expect(lines.length).toBe(5)
  expect(shown.length).toBe(6)
  expect(head).toBeUndefined()
})

it('uses the sides in the names if the rig follows the body', () => {
  expect(new Figure(kSkeleton, kRig, true).sides.slice(3)).toEqual(['right', 'right', 'left', 'middle'])
})

it('rotates tips with their joints', () => {
  const figure = new Figure(kSkeleton, kRig),
    pose = restPose(kSkeleton)
  pose.rotations.set([0, 0, Math.SQRT1_2, Math.SQRT1_2], 4 * 2)
  figure.place(pose)
  const top = [...figure.points.subarray(18, 21)]
  expect(top.map((value) => Number(value.toFixed(4)))).toEqual([-0.2, 1.6, 0])
})
