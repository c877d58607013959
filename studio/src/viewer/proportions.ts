import { Vector3 } from 'three'
import { restPositions, type Rig, type Skeleton } from '../motion/skeleton'

/** Where a signer's parts are in the rest pose, and which way the signer faces; model space, metres. */
export class Proportions {
  readonly up = new Vector3(0, 1, 0)
  /** To the signer's left. */
  readonly left = new Vector3(1, 0, 0)
  readonly front = new Vector3(0, 0, 1)
  /** How large the signer is beside one whose shoulders are 0.35 m apart. */
  readonly scale: number
  private readonly rest: Float32Array

  constructor(readonly skeleton: Skeleton, readonly rig: Rig) {
    this.rest = restPositions(skeleton)
    const pelvis = this.at('pelvis'), neck = this.at('neck') ?? this.at('head')
    const left = this.at('left_upper_arm'), right = this.at('right_upper_arm')
    if (pelvis && neck && neck.distanceTo(pelvis) > 0.05) this.up.copy(neck).sub(pelvis).normalize()
    if (left && right && left.distanceTo(right) > 0.05) this.left.copy(left).sub(right)
    this.left.addScaledVector(this.up, -this.left.dot(this.up)).normalize()
    this.front.copy(this.left).cross(this.up)
    this.scale = left && right ? Math.max(0.3, left.distanceTo(right) / 0.35) : 1
  }

  joint(part: string): number {
    return this.rig[part]?.joint ?? -1
  }

  /** Of a part, a joint or a tip; none where the rig has no such part. */
  at(part: string): Vector3 | undefined {
    const found = this.rig[part]
    if (!found) return undefined
    const at = this.ofJoint(found.joint)
    if (found.offset) at.add(new Vector3(...found.offset))
    return at
  }

  ofJoint(joint: number): Vector3 {
    return new Vector3(this.rest[3 * joint], this.rest[3 * joint + 1], this.rest[3 * joint + 2])
  }

  /** A place told by steps to the left, up and to the front, in metres of a signer of scale 1. */
  from(origin: Vector3, left: number, up: number, front: number): Vector3 {
    const s = this.scale
    return origin.clone().addScaledVector(this.left, left * s).addScaledVector(this.up, up * s).addScaledVector(this.front, front * s)
  }
}
