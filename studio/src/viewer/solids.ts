import { BufferGeometry, Color, Float32BufferAttribute, Uint16BufferAttribute, Vector3 } from 'three'

/** The level of detail: `plain` for pictures of a few centimetres, of which there are many. */
export type Detail = 'fine' | 'plain'
/** Segments around a solid, rings over a limb's round end and along it, rings of an ellipsoid; `thin` solids are fingers, ears and the like. */
const kDetails = {
  fine: { thick: { around: 20, cap: 4, along: 4, rings: 18 }, thin: { around: 20, cap: 4, along: 4, rings: 18 } },
  plain: { thick: { around: 9, cap: 2, along: 1, rings: 8 }, thin: { around: 5, cap: 1, along: 1, rings: 4 } },
}
/** Metres below which a solid's radius is thin. */
const kThin = 0.02

/** One ring of a loft: an ellipse perpendicular to `axis`, attached to two joints. */
export interface Ring {
  readonly at: Vector3
  /** Half axes along `side` and `front`, metres. */
  readonly side: number
  readonly front: number
  readonly joints: readonly [number, number]
  /** The weight of the second joint, 0 to 1. */
  readonly part: number
}

/** Builds one skinned geometry of many solids. Everything is in model space of the rest pose. */
export class SolidBuilder {
  private readonly positions: number[] = []
  private readonly colors: number[] = []
  private readonly skinIndices: number[] = []
  private readonly skinWeights: number[] = []
  private readonly indices: number[] = []
  private readonly detail: (typeof kDetails)[Detail]

  constructor(detail: Detail = 'fine') {
    this.detail = kDetails[detail]
  }

  /** Adds a limb from `a` to `b` with round ends; `flat` compresses it along a direction (unit) by a factor. */
  limb(a: Vector3, b: Vector3, radiusA: number, radiusB: number, joint: number, color: Color, flat?: { along: Vector3; factor: number }): void {
    const axis = b.clone().sub(a)
    const length = axis.length()
    if (length < 1e-5) axis.set(0, 1, 0)
    else axis.divideScalar(length)
    const side = perpendicular(axis, flat?.along)
    const front = axis.clone().cross(side)
    const rings: { at: Vector3; radius: number }[] = []
    const shape = Math.max(radiusA, radiusB) < kThin ? this.detail.thin : this.detail.thick
    const { cap, along } = shape
    for (let i = 0; i <= cap; ++i) {
      const angle = (i / cap) * (Math.PI / 2)
      rings.push({ at: a.clone().addScaledVector(axis, -radiusA * Math.cos(angle)), radius: radiusA * Math.sin(angle) })
    }
    for (let i = 1; i < along; ++i) rings.push({ at: a.clone().lerp(b, i / along), radius: radiusA + ((radiusB - radiusA) * i) / along })
    for (let i = 0; i <= cap; ++i) {
      const angle = (i / cap) * (Math.PI / 2)
      rings.push({ at: b.clone().addScaledVector(axis, radiusB * Math.sin(angle)), radius: radiusB * Math.cos(angle) })
    }
    const factor = flat?.factor ?? 1
    this.loft(
      rings.map(({ at, radius }) => ({ at, side: radius * factor, front: radius, joints: [joint, joint], part: 0 })),
      side,
      front,
      color,
      shape.around,
    )
  }

  ellipsoid(
    center: Vector3,
    radii: Vector3,
    side: Vector3,
    up: Vector3,
    joint: number,
    color: Color | ((at: Vector3) => Color),
    shape: (latitude: number) => { side: number; front: number; shift: number } = () => ({ side: 1, front: 1, shift: 0 }),
  ): void {
    const front = side.clone().cross(up)
    const rings: Ring[] = []
    const shaped = Math.min(radii.x, radii.y, radii.z) < kThin ? this.detail.thin : this.detail.thick
    const steps = shaped.rings
    for (let i = 0; i <= steps; ++i) {
      const y = -Math.cos((i / steps) * Math.PI),
        r = Math.sin((i / steps) * Math.PI)
      const bent = shape(y)
      rings.push({
        at: center
          .clone()
          .addScaledVector(up, y * radii.y)
          .addScaledVector(front, bent.shift * radii.z),
        side: r * radii.x * bent.side,
        front: r * radii.z * bent.front,
        joints: [joint, joint],
        part: 0,
      })
    }
    this.loft(rings, side, front, color, shaped.around)
  }

  /** Adds a surface through stacked rings with common directions. */
  loft(rings: readonly Ring[], side: Vector3, front: Vector3, color: Color | ((at: Vector3) => Color), around = this.detail.thick.around): void {
    const base = this.positions.length / 3
    const at = new Vector3()
    for (const ring of rings) {
      for (let i = 0; i < around; ++i) {
        const angle = (i / around) * 2 * Math.PI
        at.copy(ring.at)
          .addScaledVector(side, Math.cos(angle) * ring.side)
          .addScaledVector(front, Math.sin(angle) * ring.front)
        const tint = typeof color === 'function' ? color(at) : color
        this.positions.push(at.x, at.y, at.z)
        this.colors.push(tint.r, tint.g, tint.b)
        this.skinIndices.push(ring.joints[0], ring.joints[1], 0, 0)
        this.skinWeights.push(1 - ring.part, ring.part, 0, 0)
      }
    }
    const outward =
      rings.length > 1
        ? Math.sign(
            side
              .clone()
              .cross(front)
              .dot(rings[rings.length - 1].at.clone().sub(rings[0].at)),
          ) || 1
        : 1
    for (let r = 0; r + 1 < rings.length; ++r) {
      for (let i = 0; i < around; ++i) {
        const next = (i + 1) % around
        const p = base + r * around + i,
          q = base + r * around + next
        const u = p + around,
          v = q + around
        if (outward > 0) this.indices.push(p, q, u, q, v, u)
        else this.indices.push(p, u, q, q, u, v)
      }
    }
  }

  geometry(): BufferGeometry {
    const geometry = new BufferGeometry()
    geometry.setAttribute('position', new Float32BufferAttribute(this.positions, 3))
    geometry.setAttribute('color', new Float32BufferAttribute(this.colors, 3))
    geometry.setAttribute('skinIndex', new Uint16BufferAttribute(this.skinIndices, 4))
    geometry.setAttribute('skinWeight', new Float32BufferAttribute(this.skinWeights, 4))
    geometry.setIndex(this.indices)
    geometry.computeVertexNormals()
    return geometry
  }
}

/** Returns a unit vector perpendicular to `axis`, as close as possible to the direction `wanted`. */
export function perpendicular(axis: Vector3, wanted?: Vector3): Vector3 {
  const side = (wanted ?? (Math.abs(axis.y) < 0.9 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1))).clone()
  side.addScaledVector(axis, -side.dot(axis))
  if (side.lengthSq() < 1e-8) return perpendicular(axis)
  return side.normalize()
}
