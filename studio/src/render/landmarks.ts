import { Quaternion, Vector3 } from 'three'
import { Kinematics } from '../motion/kinematics'
import { restPose } from '../motion/pose'
import { chainTo, type Skeleton } from '../motion/skeleton'
import type { OpenedMotion } from '../motion/source'
import { Proportions } from '../viewer/proportions'

/** Positions in each frame of what a view must show: [3 · (frame · points + point)], metres, model space. */
export interface Landmarks {
  readonly points: number
  readonly places: Float32Array
}

/** A point attached to a joint, `offset` metres from it in its space. */
export interface Point {
  readonly joint: number
  readonly offset: Vector3
}

/** Returns the point at a joint itself. */
export function jointAlone(joint: number): Point {
  return { joint, offset: new Vector3() }
}

/** Returns the points of a hand: all its joints, and the fingertips. Empty if the rig has no such hand. */
export function handPoints({ store, rig }: OpenedMotion, side: 'left' | 'right'): Point[] {
  const { skeleton } = store
  const wrist = rig[`${side}_hand`]?.joint ?? -1
  const inHand = (joint: number) => chainTo(skeleton, joint).includes(wrist)
  const joints = skeleton.joints.flatMap((_, j) => (inHand(j) ? [jointAlone(j)] : []))
  const tips = Object.values(rig).flatMap((part) => (part?.offset && inHand(part.joint) ? [{ joint: part.joint, offset: new Vector3(...part.offset) }] : []))
  return [...joints, ...tips]
}

/** Returns points of the body from the waist to above the hair; parts missing in the rig are left out. */
export function bustPoints({ rig }: OpenedMotion, signer: Proportions): Point[] {
  const { up, scale } = signer
  const points: Point[] = []
  if (rig.pelvis) points.push({ joint: rig.pelvis.joint, offset: up.clone().multiplyScalar(-0.06 * scale) })
  const head = rig.head_top ?? rig.head
  if (head) {
    const top = new Vector3(...(head.offset ?? [0, 0, 0])).addScaledVector(up, rig.head_top ? 0 : 0.19 * scale)
    points.push({ joint: head.joint, offset: top.addScaledVector(up, 0.07 * scale) })
  }
  return points
}

/** Computes the positions of points in all frames of a motion, which must all be loaded. */
export function follow({ store }: OpenedMotion, points: readonly Point[]): Landmarks {
  const { skeleton, rate, length } = store
  const pose = restPose(skeleton),
    model = new Kinematics(skeleton)
  const joints = withParents(skeleton, points)
  const places = new Float32Array(3 * points.length * length)
  const at = new Vector3(),
    turn = new Quaternion()
  for (let frame = 0, to = 0; frame < length; ++frame) {
    store.sample(frame / rate, pose)
    model.update(pose, joints)
    for (const { joint, offset } of points) {
      at.copy(offset).applyQuaternion(turn.fromArray(model.rotations, 4 * joint))
      for (let k = 0; k < 3; ++k) places[to++] = model.positions[3 * joint + k] + at.getComponent(k)
    }
  }
  return { points: points.length, places }
}

function withParents(skeleton: Skeleton, points: readonly Point[]): number[] {
  return [...new Set(points.flatMap(({ joint }) => chainTo(skeleton, joint)))].sort((a, b) => a - b)
}
