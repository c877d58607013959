import { Vector3 } from 'three'
import { Kinematics } from '../motion/kinematics'
import { restPose } from '../motion/pose'
import { chainTo } from '../motion/skeleton'
import type { OpenedMotion } from '../motion/source'
import type { Proportions } from './proportions'
import { someFrames } from './stance'

/** The direction a signer faces: horizontal unit vectors in model space, and the signer's scale. */
export interface Facing {
  readonly up: Vector3
  readonly left: Vector3
  readonly front: Vector3
  readonly scale: number
}

/**
 * Returns the mean direction of the shoulders in up to a fixed number of loaded frames: captures face any direction, whatever their skeleton does at rest.
 * Falls back to the rest pose.
 */
export function facingOf(motion: OpenedMotion, signer: Proportions): Facing {
  const { store, rig } = motion
  const left = rig.left_upper_arm?.joint,
    right = rig.right_upper_arm?.joint
  if (left === undefined || right === undefined) return signer
  const frames = someFrames(motion)
  const joints = [...new Set([...chainTo(store.skeleton, left), ...chainTo(store.skeleton, right)])].sort((a, b) => a - b)
  const pose = restPose(store.skeleton),
    model = new Kinematics(store.skeleton),
    place = model.positions
  const across = new Vector3(),
    one = new Vector3()
  for (const frame of frames) {
    store.sample(frame / store.rate, pose)
    model.update(pose, joints)
    one
      .fromArray(place, 3 * left)
      .sub(new Vector3().fromArray(place, 3 * right))
      .setY(0)
    if (one.lengthSq() > 1e-4) across.add(one.normalize())
  }
  if (across.length() <= 0.1 * frames.length) return signer
  const up = new Vector3(0, 1, 0)
  across.normalize()
  return { up, left: across, front: across.clone().cross(up), scale: signer.scale }
}
