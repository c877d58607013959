import type { Measures } from './measures'

/** Camera directions: rotation about the vertical from the figure's front, and downward tilt; degrees. */
export const kViews = { angle: { turn: 35, tilt: 14 }, front: { turn: 0, tilt: 0 }, side: { turn: 90, tilt: 0 } } as const
export type ViewName = keyof typeof kViews

/** The directions of the axes of model space in the picture: x to the right, y up. The projection is orthographic. */
export interface Axes {
  readonly x: readonly [number, number, number]
  readonly y: readonly [number, number, number]
}

/** Returns the axes for a body whose shoulders point along `across` from right to left; by default it faces along z. */
export function axesOf(across: readonly [number, number] | undefined, view: ViewName): Axes {
  const [ax, az] = across ?? [1, 0]
  const turn = (kViews[view].turn * Math.PI) / 180,
    tilt = (kViews[view].tilt * Math.PI) / 180
  // Its front is left × up, where the camera is before rotation.
  const fx = -az,
    fz = ax
  const dx = fx * Math.cos(turn) + fz * Math.sin(turn),
    dz = fz * Math.cos(turn) - fx * Math.sin(turn)
  return { x: [dz, 0, -dx], y: [-dx * Math.sin(tilt), Math.cos(tilt), -dz * Math.sin(tilt)] }
}

export const along = (axis: readonly [number, number, number], x: number, y: number, z: number) => axis[0] * x + axis[1] * y + axis[2] * z

/** How a figure is fitted into a picture. */
export interface Fit {
  /** Pixels per metre. */
  readonly scale: number
  /** The position of the model's origin in pixels, from the left and from the top. */
  readonly x: number
  readonly y: number
  /** A round length in metres for the scale mark: 1 m for a person. */
  readonly mark: number
  /** The area of the floor drawn, in whole marks: x and z of its corners. Undefined if the figure is far above or below the floor. */
  readonly floor?: { readonly x: readonly [number, number]; readonly z: readonly [number, number] }
}

const kMostCells = 40

/** Fits the figure with the floor below it into a picture of the given size in pixels, with room for the mark on the left. */
export function fitted(measures: Pick<Measures, 'least' | 'most' | 'cloud'>, axes: Axes, width: number, height: number, margin: number): Fit {
  const { least, most } = measures
  const size = Math.max(1e-6, ...[0, 1, 2].map((axis) => most[axis] - least[axis]))
  const mark = roundBelow(size)
  const isNear = least[1] < 1.5 * size && most[1] > -1.5 * size
  const { left, right, low, high } = bounds(measures.cloud, axes, isNear)
  const room = 2.5 * margin // for the mark and its label
  const scale = Math.min((width - room - margin) / Math.max(1e-6, right - left), (height - 2 * margin) / Math.max(1e-6, high - low))
  return {
    scale,
    x: room + (width - room - margin) / 2 - (scale * (left + right)) / 2,
    y: height / 2 + (scale * (low + high)) / 2,
    mark,
    floor: isNear ? floorBelow(measures, mark) : undefined,
  }
}

/** Returns the bounds of the points in the picture, in metres; optionally including their projections on the floor. */
function bounds(cloud: Float32Array, axes: Axes, withFloor: boolean) {
  let left = Infinity,
    right = -Infinity,
    low = Infinity,
    high = -Infinity
  for (let at = 0; at < cloud.length; at += 3) {
    const x = along(axes.x, cloud[at], cloud[at + 1], cloud[at + 2])
    left = Math.min(left, x)
    right = Math.max(right, x)
    for (const y of withFloor ? [cloud[at + 1], 0] : [cloud[at + 1]]) {
      const up = along(axes.y, cloud[at], y, cloud[at + 2])
      low = Math.min(low, up)
      high = Math.max(high, up)
    }
  }
  return { left, right, low, high }
}

/** Returns the floor area in whole marks; undefined if there are too many to draw. */
function floorBelow({ least, most }: Pick<Measures, 'least' | 'most'>, mark: number): Fit['floor'] {
  const whole = (axis: 0 | 2): [number, number] => [mark * Math.floor(least[axis] / mark), mark * Math.ceil(most[axis] / mark)]
  const x = whole(0),
    z = whole(2)
  return (x[1] - x[0] + z[1] - z[0]) / mark <= kMostCells ? { x, z } : undefined
}

/** Returns the greatest power of ten that is at most the given length. */
export function roundBelow(length: number): number {
  return Number(`1e${Math.floor(Math.log10(length) + 1e-9)}`)
}
