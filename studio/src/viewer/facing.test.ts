import { Vector3 } from 'three'
import { expect, it } from 'vitest'
import { blockOf } from '../motion/encode'
import { FrameStore } from '../motion/frame_store'
import { restPose } from '../motion/pose'
import type { Skeleton } from '../motion/skeleton'
import { facingOf } from './facing'
import { Proportions } from './proportions'

const kSkeleton: Skeleton = {
  joints: [
    { name: 'p', parent: -1, offset: [0, 1, 0] },
    { name: 'n', parent: 0, offset: [0, 0.5, 0] },
    { name: 'l', parent: 1, offset: [0.2, 0, 0] },
    { name: 'r', parent: 1, offset: [-0.2, 0, 0] },
  ],
  translated: [0],
  tracks: [],
}
const kRig = { pelvis: { joint: 0 }, neck: { joint: 1 }, left_upper_arm: { joint: 2 }, right_upper_arm: { joint: 3 } }

/** A motion rotated about the vertical by the given radians in each frame. */
function turned(angles: readonly number[]) {
  const poses = angles.map((angle) => {
    const pose = restPose(kSkeleton)
    pose.rotations.set([0, Math.sin(angle / 2), 0, Math.cos(angle / 2)], 0)
    return pose
  })
  const store = new FrameStore(kSkeleton, 50, kRig, angles.length)
  store.put(blockOf(kSkeleton, poses, 0))
  return { store, rig: kRig, originMs: 0, declarations: {}, recording: 'x' }
}

it('is the direction of the shoulders, not that of the rest pose', () => {
  const signer = new Proportions(kSkeleton, kRig)
  const { front, left, up } = facingOf(turned([Math.PI, Math.PI + 0.3, Math.PI - 0.3]), signer)
  expect(front.distanceTo(new Vector3(0, 0, -1))).toBeLessThan(1e-3)
  expect(left.distanceTo(new Vector3(-1, 0, 0))).toBeLessThan(1e-3)
  expect(up.y).toBe(1)
})

it('is that of the rest pose if the shoulders face everywhere, or no frame is loaded', () => {
  const signer = new Proportions(kSkeleton, kRig)
  expect(facingOf(turned([0, Math.PI / 2, Math.PI, -Math.PI / 2]), signer)).toBe(signer)
  expect(facingOf({ ...turned([0]), store: new FrameStore(kSkeleton, 50, kRig, 10) }, signer)).toBe(signer)
})
