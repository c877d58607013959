import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Group, LineBasicMaterial, LineSegments, Points, PointsMaterial } from 'three'
import type { Kinematics } from '../motion/kinematics'
import type { Skeleton } from '../motion/skeleton'

/** The skeleton itself, drawn over the body. */
export class BonesOverlay {
  readonly object = new Group()
  private readonly ends: Float32Array
  private readonly pairs: readonly number[]
  private readonly lines: LineSegments
  private readonly points: Points

  constructor(
    skeleton: Skeleton,
    private readonly model: Kinematics,
  ) {
    this.pairs = skeleton.joints.flatMap(({ parent }, j) => (parent < 0 ? [] : [parent, j]))
    this.ends = new Float32Array(3 * this.pairs.length)
    this.lines = new LineSegments(dynamic(this.ends), new LineBasicMaterial({ color: 0x2ee6c0, depthTest: false, transparent: true }))
    this.points = new Points(
      dynamic(model.positions),
      new PointsMaterial({ color: 0xffffff, size: 4, sizeAttenuation: false, depthTest: false, transparent: true }),
    )
    for (const one of [this.lines, this.points]) {
      one.frustumCulled = false
      one.renderOrder = 2
      this.object.add(one)
    }
  }

  /** Takes the positions of the model's last update. */
  update(): void {
    for (let i = 0; i < this.pairs.length; ++i) {
      const from = 3 * this.pairs[i]
      for (let k = 0; k < 3; ++k) this.ends[3 * i + k] = this.model.positions[from + k]
    }
    this.lines.geometry.getAttribute('position').needsUpdate = true
    this.points.geometry.getAttribute('position').needsUpdate = true
  }

  dispose(): void {
    for (const one of [this.lines, this.points]) {
      one.geometry.dispose()
      ;(one.material as LineBasicMaterial).dispose()
    }
  }
}

function dynamic(places: Float32Array): BufferGeometry {
  const geometry = new BufferGeometry()
  const attribute = new BufferAttribute(places, 3)
  attribute.setUsage(DynamicDrawUsage)
  geometry.setAttribute('position', attribute)
  return geometry
}
