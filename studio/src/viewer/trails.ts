import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Group,
  InstancedMesh,
  Line,
  LineBasicMaterial,
  Matrix4,
  MeshBasicMaterial,
  SphereGeometry,
} from 'three'
import type { FrameStore } from '../motion/frame_store'

const kPoints = 64
/** The length of a trail in seconds. */
const kReach = 1.2
/** The colours of the hands everywhere: left, right. Distinguishable for all forms of colour vision, on dark and light. */
export const kHandColors = ['#f2a33a', '#3fa7f0'] as const

/** The paths of the wrists: a line, and beads at regular times, so that their distance shows the speed. */
export class Trails {
  readonly object = new Group()
  private readonly lines: Line[] = []
  private readonly beads: InstancedMesh[] = []
  private readonly places = [0, 1].map(() => new Float32Array(3 * kPoints))
  private readonly matrix = new Matrix4()

  constructor(private readonly store: FrameStore) {
    const sphere = new SphereGeometry(1, 10, 8)
    for (let hand = 0; hand < 2; ++hand) {
      const color = new Color(kHandColors[hand])
      const geometry = new BufferGeometry()
      const position = new BufferAttribute(this.places[hand], 3)
      position.setUsage(DynamicDrawUsage)
      geometry.setAttribute('position', position)
      const line = new Line(geometry, new LineBasicMaterial({ color, transparent: true, opacity: 0.8 }))
      line.frustumCulled = false
      const beads = new InstancedMesh(sphere, new MeshBasicMaterial({ color, transparent: true, opacity: 0.85 }), kPoints / 4)
      beads.instanceMatrix.setUsage(DynamicDrawUsage)
      beads.frustumCulled = false
      this.lines.push(line)
      this.beads.push(beads)
      this.object.add(line, beads)
    }
  }

  /** Draws the trails that end at a time, in seconds from frame 0. */
  update(seconds: number): void {
    const { store } = this
    for (let hand = 0 as 0 | 1; hand < 2; hand = (hand + 1) as 0 | 1) {
      this.lines[hand].visible = this.beads[hand].visible = store.hasHand[hand]
      if (!store.hasHand[hand]) continue
      const at = this.places[hand]
      for (let i = 0; i < kPoints; ++i) {
        const back = Math.max(0, (seconds - (kReach * i) / (kPoints - 1)) * store.rate)
        const frame = Math.min(store.length - 1, Math.floor(back)),
          part = Math.min(1, back - frame)
        for (let k = 0 as 0 | 1 | 2; k < 3; k = (k + 1) as 0 | 1 | 2) {
          const a = store.hand(frame, hand, k),
            b = store.hand(Math.min(store.length - 1, frame + 1), hand, k)
          const place = Number.isNaN(b) ? a : a + (b - a) * part
          at[3 * i + k] = Number.isNaN(place) ? (i > 0 ? at[3 * (i - 1) + k] : 0) : place
        }
        if (i % 4 === 0) {
          const size = 0.0085 * (1 - (0.75 * i) / kPoints)
          this.matrix.makeScale(size, size, size).setPosition(at[3 * i], at[3 * i + 1], at[3 * i + 2])
          this.beads[hand].setMatrixAt(i / 4, this.matrix)
        }
      }
      this.lines[hand].geometry.getAttribute('position').needsUpdate = true
      this.beads[hand].instanceMatrix.needsUpdate = true
    }
  }

  dispose(): void {
    for (const line of this.lines) {
      line.geometry.dispose()
      ;(line.material as LineBasicMaterial).dispose()
    }
    for (const beads of this.beads) {
      beads.geometry.dispose()
      ;(beads.material as MeshBasicMaterial).dispose()
      beads.dispose()
    }
  }
}
