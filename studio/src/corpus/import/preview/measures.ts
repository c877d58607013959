import type { FrameStore } from '../../../motion/frame_store'
import { restPose } from '../../../motion/pose'
import type { Figure } from './figure'

/** The measurements of a figure needed to draw it; metres, model space. */
export interface Measures {
  /** The bounds of all points in all frames: x, y, z. */
  readonly least: readonly [number, number, number]
  readonly most: readonly [number, number, number]
  /** Point positions in some of the frames: x, y, z each. */
  readonly cloud: Float32Array
  /** The median distance from the lowest point to the highest. */
  readonly height: number
  /** The vertical component of the direction from pelvis to head: 1 upright, 0 lying, −1 upside down; undefined if the rig lacks one of them. */
  readonly rise?: number
  /** Horizontal direction from the right shoulder to the left: x and z. Undefined if it cannot be determined. */
  readonly across?: readonly [number, number]
  /** Horizontal vector from the parts named right to those named left: x and z. */
  readonly sides: readonly [number, number]
}

/** The maximum number of frames whose points are stored. */
const kCloudFrames = 40

/** Measures all frames that are loaded. */
export function measured(figure: Figure, store: FrameStore): Measures {
  const { points, shown, rig, sides } = figure
  const pose = restPose(store.skeleton)
  const least: [number, number, number] = [Infinity, Infinity, Infinity],
    most: [number, number, number] = [-Infinity, -Infinity, -Infinity]
  const heights: number[] = []
  const every = Math.ceil(store.length / kCloudFrames)
  const cloud: number[] = []
  const left = rig.left_upper_arm?.joint,
    right = rig.right_upper_arm?.joint,
    pelvis = rig.pelvis?.joint,
    head = rig.head?.joint ?? rig.neck?.joint
  let across: [number, number] = [0, 0],
    rise = 0
  const mean = { left: [0, 0], right: [0, 0] }
  const ofSide = { left: shown.filter((point) => sides[point] === 'left'), right: shown.filter((point) => sides[point] === 'right') }
  for (let frame = 0; frame < store.length; ++frame) {
    store.sample(frame / store.rate, pose)
    figure.place(pose)
    let low = Infinity,
      high = -Infinity
    for (const point of shown) {
      for (let axis = 0; axis < 3; ++axis) {
        const at = points[3 * point + axis]
        least[axis] = Math.min(least[axis], at)
        most[axis] = Math.max(most[axis], at)
        if (frame % every === 0) cloud.push(at)
      }
      low = Math.min(low, points[3 * point + 1])
      high = Math.max(high, points[3 * point + 1])
    }
    heights.push(high - low)
    if (left !== undefined && right !== undefined)
      across = added(across, unit(points[3 * left] - points[3 * right], points[3 * left + 2] - points[3 * right + 2]))
    if (pelvis !== undefined && head !== undefined) {
      const trunk = [0, 1, 2].map((axis) => points[3 * head + axis] - points[3 * pelvis + axis])
      rise += trunk[1] / Math.max(1e-9, Math.hypot(...trunk))
    }
    for (const side of ['left', 'right'] as const) {
      for (const point of ofSide[side]) {
        mean[side][0] += points[3 * point] / ofSide[side].length
        mean[side][1] += points[3 * point + 2] / ofSide[side].length
      }
    }
  }
  heights.sort((a, b) => a - b)
  const count = Math.max(1, store.length)
  return {
    least,
    most,
    cloud: Float32Array.from(cloud),
    height: heights[heights.length >> 1] ?? 0,
    rise: pelvis !== undefined && head !== undefined ? rise / count : undefined,
    across: Math.hypot(...across) > 0.1 * count ? unit(...across) : undefined,
    sides: [(mean.left[0] - mean.right[0]) / count, (mean.left[1] - mean.right[1]) / count],
  }
}

const added = (a: readonly [number, number], b: readonly [number, number]): [number, number] => [a[0] + b[0], a[1] + b[1]]
/** Returns the vector with length 1; a zero vector stays zero. */
function unit(x: number, z: number): [number, number] {
  const length = Math.hypot(x, z)
  return length > 1e-9 ? [x / length, z / length] : [0, 0]
}

/** The posture of a body. */
export type Stand = 'upright' | 'lying' | 'upsideDown'
export function standOf(rise: number): Stand {
  return rise > 0.7 ? 'upright' : rise < -0.7 ? 'upsideDown' : 'lying'
}
