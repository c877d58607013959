import type { Pose } from '../../../motion/pose'
import { Kinematics } from '../../../motion/kinematics'
import { chainTo, type Rig, type Skeleton } from '../../../motion/skeleton'

/** The side of the signer to which something belongs, by its name in the file. */
export type Side = 'left' | 'right' | 'middle'
/** A line of the figure, between two of its points. */
export interface Line {
  readonly from: number
  readonly to: number
  readonly side: Side
  /** Part of a hand: drawn thinner. */
  readonly thin: boolean
}

/** A skeleton as lines between points: its joints, followed by the tips from the rig. */
export class Figure {
  /** [3 · point], metres, model space. */
  readonly points: Float32Array
  readonly lines: readonly Line[]
  /** The points of the body: without those above the pelvis, such as a reference joint at the origin. */
  readonly shown: readonly number[]
  readonly sides: readonly Side[]
  /** The points between which the head is, if the rig has both. */
  readonly head?: { readonly from: number; readonly to: number }
  private readonly kinematics: Kinematics
  private readonly tips: readonly { readonly joint: number; readonly offset: readonly [number, number, number] }[]

  /** `swapped`: the rig matches a body whose names say left for what is on the right. */
  constructor(
    readonly skeleton: Skeleton,
    readonly rig: Rig,
    swapped = false,
  ) {
    const count = skeleton.joints.length
    const tips = Object.entries(rig).flatMap(([part, place]) => (place?.offset ? [{ part, joint: place.joint, offset: place.offset }] : []))
    this.tips = tips
    this.kinematics = new Kinematics(skeleton)
    this.points = new Float32Array(3 * (count + tips.length))
    const above = new Set(rig.pelvis ? chainTo(skeleton, rig.pelvis.joint).slice(0, -1) : [])
    const sides = sidesOf(skeleton, rig, swapped)
    const hands = handsOf(skeleton, rig)
    this.sides = [...sides, ...tips.map(({ joint }) => sides[joint])]
    this.shown = [...this.sides.keys()].filter((point) => !above.has(point))
    const bones = skeleton.joints.flatMap(({ parent }, joint): Line[] =>
      parent < 0 || above.has(parent) ? [] : [{ from: parent, to: joint, side: sides[joint], thin: hands.has(parent) }],
    )
    const ends = tips.map(({ joint }, k): Line => ({ from: joint, to: count + k, side: sides[joint], thin: hands.has(joint) }))
    this.lines = [...bones, ...ends]
    const top = tips.findIndex(({ part }) => part === 'head_top')
    const to = top >= 0 ? count + top : rig.head_top?.joint
    if (rig.head && to !== undefined) this.head = { from: rig.head.joint, to }
  }

  /** Moves every point to its position in a pose. */
  place(pose: Pose): void {
    const { kinematics, points, skeleton } = this
    kinematics.update(pose)
    points.set(kinematics.positions)
    this.tips.forEach(({ joint, offset }, k) => {
      const at = 3 * (skeleton.joints.length + k)
      const [x, y, z, w] = kinematics.rotations.subarray(4 * joint, 4 * joint + 4)
      const [ox, oy, oz] = offset
      const cx = y * oz - z * oy + w * ox,
        cy = z * ox - x * oz + w * oy,
        cz = x * oy - y * ox + w * oz
      points[at] = points[3 * joint] + ox + 2 * (y * cz - z * cy)
      points[at + 1] = points[3 * joint + 1] + oy + 2 * (z * cx - x * cz)
      points[at + 2] = points[3 * joint + 2] + oz + 2 * (x * cy - y * cx)
    })
  }
}

/** Returns the side of each joint: that of the nearest ancestor that is a part with a side. */
function sidesOf(skeleton: Skeleton, rig: Rig, swapped: boolean): Side[] {
  const named = new Map<number, Side>()
  for (const [part, place] of Object.entries(rig)) {
    const side = /^(left|right)_/.exec(part)?.[1]
    if (side && place) named.set(place.joint, (side === 'left') === swapped ? 'right' : 'left')
  }
  const sides: Side[] = []
  skeleton.joints.forEach(({ parent }, joint) => sides.push(named.get(joint) ?? (parent < 0 ? 'middle' : sides[parent])))
  return sides
}

/** Returns the wrists and all joints below them. */
function handsOf(skeleton: Skeleton, rig: Rig): ReadonlySet<number> {
  const hands = new Set<number>()
  skeleton.joints.forEach(({ parent }, joint) => {
    if (joint === rig.left_hand?.joint || joint === rig.right_hand?.joint || hands.has(parent)) hands.add(joint)
  })
  return hands
}
