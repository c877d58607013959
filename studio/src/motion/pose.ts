import type { Skeleton } from './skeleton'

/** One moment of a motion, owned. Created once and refilled for every frame, so that drawing allocates nothing. */
export interface Pose {
  /** [4 · joint], x y z w, unit length, relative to the parent. */
  readonly rotations: Float32Array
  /** [3 · joint], metres, in the parent's space: the offset, or the translation of a joint that has one. */
  readonly positions: Float32Array
  /** [track], in the skeleton's order. */
  readonly tracks: Float32Array
}

/** The rest pose: every local rotation is the identity. */
export function restPose(skeleton: Skeleton): Pose {
  const count = skeleton.joints.length
  const pose: Pose = {
    rotations: new Float32Array(4 * count),
    positions: new Float32Array(3 * count),
    tracks: new Float32Array(skeleton.tracks.length),
  }
  skeleton.joints.forEach((joint, j) => {
    pose.rotations[4 * j + 3] = 1
    pose.positions.set(joint.offset, 3 * j)
  })
  return pose
}
