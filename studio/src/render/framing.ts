import type { Vector3 } from 'three'
import type { Landmarks } from './landmarks'

/** The axes of a view in model space, unit length: to its right, up, and from the subject to the camera. */
export interface Axes {
  readonly right: Vector3
  readonly up: Vector3
  readonly back: Vector3
}

/** The position of a camera that looks along −back: metres along the axes. */
export interface Stand {
  right: number
  up: number
  back: number
}

/** The part of a view that must contain everything: its half extents at a distance of one metre from the camera. */
export interface Window {
  readonly side: number
  readonly top: number
  readonly bottom: number
}

/** Returns what a camera of this lens (degrees, vertical) sees, less a margin, and less `foot` pixels at the bottom that a caption covers. */
export function windowOf(lens: number, width: number, height: number, foot: number): Window {
  const half = Math.tan((lens * Math.PI) / 360),
    margin = 0.04
  return { side: half * (width / height - margin), top: half * (1 - margin), bottom: half * Math.max(0.2, 1 - margin - (2 * foot) / height) }
}

/** How close a camera may be to the points it must show, separately for each side, so that frames can be combined. */
interface Bounds {
  left: number
  right: number
  top: number
  bottom: number
}

const kNowhere: Readonly<Bounds> = { left: -Infinity, right: -Infinity, top: -Infinity, bottom: -Infinity }

/**
 * A point (x, y, z) along the axes is within the window of a camera at (a, b, d) if |x − a| ≤ side · (d − z), and likewise vertically. So each side gives a
 * minimum d that falls or rises with a or b, and the best position is where two sides meet.
 */
export class Framing {
  constructor(
    private readonly axes: Axes,
    private readonly window: Window,
  ) {}

  /**
   * Returns the nearest position that contains all points, each with a radius of `around` metres, in every frame: centred between them, or with the horizontal
   * coordinate `middle` if given.
   */
  still(marks: Landmarks, around: number, middle?: number): Stand {
    const all: Bounds = { ...kNowhere }
    this.widen(all, marks, 0, marks.places.length / 3, around)
    const stand = this.nearest(all)
    if (middle === undefined) return stand
    return { ...stand, right: middle, back: this.distance(all, middle, stand.up) }
  }

  /**
   * Returns a position for each frame, which follows the points, smoothed over `smooth` frames to either side, looking ahead as well as back, and never loses
   * one from the window.
   */
  moving(marks: Landmarks, around: number, smooth: number): Stand[] {
    const frames = marks.points ? marks.places.length / (3 * marks.points) : 0
    const bounds = Array.from({ length: frames }, (_, frame) => {
      const one: Bounds = { ...kNowhere }
      this.widen(one, marks, frame * marks.points, (frame + 1) * marks.points, around)
      return one
    })
    const stands = bounds.map((one) => this.nearest(one))
    const rights = softened(
        stands.map(({ right }) => right),
        smooth,
      ),
      ups = softened(
        stands.map(({ up }) => up),
        smooth,
      )
    const needed = bounds.map((one, frame) => this.distance(one, rights[frame], ups[frame]))
    // A mean of the surrounding maxima is never below the value itself.
    const backs = softened(largestAround(needed, smooth), smooth)
    return stands.map((_, frame) => ({ right: rights[frame], up: ups[frame], back: backs[frame] }))
  }

  private widen(bounds: Bounds, { places }: Landmarks, from: number, to: number, around: number): void {
    const { right, up, back } = this.axes,
      { side, top, bottom } = this.window
    for (let i = 3 * from; i < 3 * to; i += 3) {
      const px = places[i],
        py = places[i + 1],
        pz = places[i + 2]
      const x = right.x * px + right.y * py + right.z * pz
      const y = up.x * px + up.y * py + up.z * pz
      const z = back.x * px + back.y * py + back.z * pz + around
      bounds.right = Math.max(bounds.right, (x + around) / side + z)
      bounds.left = Math.max(bounds.left, (around - x) / side + z)
      bounds.top = Math.max(bounds.top, (y + around) / top + z)
      bounds.bottom = Math.max(bounds.bottom, (around - y) / bottom + z)
    }
  }

  private nearest(bounds: Bounds): Stand {
    const { side, top, bottom } = this.window
    const right = (side * (bounds.right - bounds.left)) / 2
    const up = (bounds.top - bounds.bottom) / (1 / top + 1 / bottom)
    return { right, up, back: this.distance(bounds, right, up) }
  }

  private distance(bounds: Bounds, right: number, up: number): number {
    const { side, top, bottom } = this.window
    return Math.max(bounds.right - right / side, bounds.left + right / side, bounds.top - up / top, bounds.bottom + up / bottom)
  }
}

/** Returns the mean of each value's neighbours up to `reach` indices away; at the ends, of the existing ones. */
export function softened(values: readonly number[], reach: number): number[] {
  const sums = [0]
  for (const value of values) sums.push(sums[sums.length - 1] + value)
  return values.map((_, i) => {
    const from = Math.max(0, i - reach),
      to = Math.min(values.length, i + reach + 1)
    return (sums[to] - sums[from]) / (to - from)
  })
}

/** Returns the maximum of each value's neighbours up to `reach` indices away. */
export function largestAround(values: readonly number[], reach: number): number[] {
  return values.map((_, i) => {
    let largest = -Infinity
    for (let j = Math.max(0, i - reach); j <= Math.min(values.length - 1, i + reach); ++j) largest = Math.max(largest, values[j])
    return largest
  })
}
