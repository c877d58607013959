import type { Pose } from './pose'
import type { Skeleton } from './skeleton'

/** Forward kinematics with its own memory: model-space positions of a skeleton's joints, pose after pose. */
export class Kinematics {
  /** [3 · joint], metres, model space. */
  readonly positions: Float32Array
  /** [4 · joint], x y z w, model space. */
  readonly rotations: Float32Array
  private readonly skeleton: Skeleton

  constructor(skeleton: Skeleton) {
    this.skeleton = skeleton
    this.positions = new Float32Array(3 * skeleton.joints.length)
    this.rotations = new Float32Array(4 * skeleton.joints.length)
  }

  /** Computes the positions of all joints, or only of `joints`, whose parents must precede them. */
  update(pose: Pose, joints?: readonly number[]): void {
    const count = joints ? joints.length : this.skeleton.joints.length
    for (let i = 0; i < count; ++i) this.place(pose, joints ? joints[i] : i)
  }

  private place(pose: Pose, j: number): void {
    const { positions: p, rotations: q } = this
    const parent = this.skeleton.joints[j].parent
    const lx = pose.rotations[4 * j],
      ly = pose.rotations[4 * j + 1],
      lz = pose.rotations[4 * j + 2],
      lw = pose.rotations[4 * j + 3]
    const ox = pose.positions[3 * j],
      oy = pose.positions[3 * j + 1],
      oz = pose.positions[3 * j + 2]
    if (parent < 0) {
      p[3 * j] = ox
      p[3 * j + 1] = oy
      p[3 * j + 2] = oz
      q[4 * j] = lx
      q[4 * j + 1] = ly
      q[4 * j + 2] = lz
      q[4 * j + 3] = lw
      return
    }
    const x = q[4 * parent],
      y = q[4 * parent + 1],
      z = q[4 * parent + 2],
      w = q[4 * parent + 3]
    // v + 2 q × (q × v + w v)
    const cx = y * oz - z * oy + w * ox,
      cy = z * ox - x * oz + w * oy,
      cz = x * oy - y * ox + w * oz
    p[3 * j] = p[3 * parent] + ox + 2 * (y * cz - z * cy)
    p[3 * j + 1] = p[3 * parent + 1] + oy + 2 * (z * cx - x * cz)
    p[3 * j + 2] = p[3 * parent + 2] + oz + 2 * (x * cy - y * cx)
    q[4 * j] = w * lx + x * lw + y * lz - z * ly
    q[4 * j + 1] = w * ly + y * lw + z * lx - x * lz
    q[4 * j + 2] = w * lz + z * lw + x * ly - y * lx
    q[4 * j + 3] = w * lw - x * lx - y * ly - z * lz
  }
}
