import { Matrix4, Quaternion, Vector3 } from 'three'
import { Kinematics } from '../motion/kinematics'
import { restPose, type Pose } from '../motion/pose'
import type { Rig, Skeleton } from '../motion/skeleton'

/** Positions of a signer's parts in the pose in which the body is built, and the signer's facing direction in it; model space, metres. */
export class Proportions {
  readonly up = new Vector3(0, 1, 0)
  /** To the signer's left. */
  readonly left = new Vector3(1, 0, 0)
  readonly front = new Vector3(0, 0, 1)
  /** The signer's size relative to one whose shoulders are 0.35 m apart. */
  readonly scale: number
  private readonly model: Kinematics

  /** `stance` is the rest pose by default; see `stanceOf`. */
  constructor(
    readonly skeleton: Skeleton,
    readonly rig: Rig,
    readonly stance: Pose = restPose(skeleton),
  ) {
    this.model = new Kinematics(skeleton)
    this.model.update(stance)
    const pelvis = this.at('pelvis'),
      neck = this.at('neck') ?? this.at('head')
    const left = this.at('left_upper_arm'),
      right = this.at('right_upper_arm')
    if (pelvis && neck && neck.distanceTo(pelvis) > 0.05) this.up.copy(neck).sub(pelvis).normalize()
    if (left && right && left.distanceTo(right) > 0.05) this.left.copy(left).sub(right)
    this.left.addScaledVector(this.up, -this.left.dot(this.up)).normalize()
    this.front.copy(this.left).cross(this.up)
    this.scale = left && right ? Math.max(0.3, left.distanceTo(right) / 0.35) : 1
  }

  joint(part: string): number {
    return this.rig[part]?.joint ?? -1
  }

  /** Returns the position of a part, a joint or a tip; undefined if the rig has no such part. */
  at(part: string): Vector3 | undefined {
    const found = this.rig[part]
    if (!found) return undefined
    const at = this.ofJoint(found.joint)
    if (found.offset) at.add(new Vector3(...found.offset).applyQuaternion(this.turnOf(found.joint)))
    return at
  }

  ofJoint(joint: number): Vector3 {
    return new Vector3().fromArray(this.model.positions, 3 * joint)
  }
  /** Returns the rotation of a joint. */
  turnOf(joint: number): Quaternion {
    return new Quaternion().fromArray(this.model.rotations, 4 * joint)
  }
  /** Returns the transform from a joint's own space to model space. */
  matrixOf(joint: number): Matrix4 {
    return new Matrix4().compose(this.ofJoint(joint), this.turnOf(joint), new Vector3(1, 1, 1))
  }

  /** Returns a position given by offsets to the left, up and to the front, in metres of a signer of scale 1. */
  from(origin: Vector3, left: number, up: number, front: number): Vector3 {
    const s = this.scale
    return origin
      .clone()
      .addScaledVector(this.left, left * s)
      .addScaledVector(this.up, up * s)
      .addScaledVector(this.front, front * s)
  }
}
