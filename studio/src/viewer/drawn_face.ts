import { CapsuleGeometry, Group, Mesh, MeshLambertMaterial, Quaternion, SphereGeometry, Vector3 } from 'three'
import type { Pose } from '../motion/pose'
import { headShape } from './drawn_solids'
import type { Proportions } from './proportions'
import type { Detail } from './solids'

const kOfSide = ['eyeBlink', 'eyeSquint', 'eyeWide', 'browDown', 'browOuterUp', 'mouthSmile', 'mouthStretch'] as const
const kOfBoth = ['browInnerUp', 'jawOpen', 'mouthPucker', 'mouthFunnel'] as const
const kCommon = 2 * kOfSide.length

/** Eyes, lids, brows and mouth of the plain body, moved by tracks with ARKit's names. */
export class DrawnFace {
  /** Attached to the head's joint. */
  readonly object = new Group()
  readonly moves: boolean
  /** For each weight the index of its track, or −1. */
  private readonly tracks: readonly number[]
  private readonly weights: Float32Array
  private readonly lids: Mesh[] = []
  private readonly brows: Mesh[] = []
  private readonly mouth: Mesh
  private readonly lips: Mesh
  private readonly browHeight: number
  private readonly owned: { dispose(): void }[] = []
  private readonly s: number

  constructor(p: Proportions, tracks: readonly string[], detail: Detail = 'fine') {
    const names = [...kOfSide.map((name) => `${name}Left`), ...kOfSide.map((name) => `${name}Right`), ...kOfBoth]
    this.tracks = names.map((name) => tracks.indexOf(name))
    this.weights = new Float32Array(names.length)
    this.moves = this.tracks.some((track) => track >= 0)
    const s = (this.s = p.scale)
    const shape = headShape(p)!
    const origin = p.at('head')!
    const faced = facing(p),
      inverse = faced.clone().invert()
    this.object.quaternion.copy(p.turnOf(p.joint('head')).invert()).multiply(faced)
    const here = (at: Vector3) => at.sub(origin).applyQuaternion(inverse)
    const center = here(shape.center.clone())
    const white = this.material(0xf4f1ec),
      dark = this.material(0x241a16),
      skin = this.material(0xcf9877)
    const brown = this.material(0x2b1d17),
      red = this.material(0xb0685c),
      hollow = this.material(0x4a1a18)
    const [around, along] = detail === 'fine' ? [20, 14] : [8, 6]
    const ball = this.own(new SphereGeometry(1, around, along))
    const cap = this.own(new SphereGeometry(1, around, detail === 'fine' ? 10 : 4, 0, 2 * Math.PI, 0, Math.PI / 2))
    const bar = this.own(detail === 'fine' ? new CapsuleGeometry(1, 6, 4, 10) : new CapsuleGeometry(1, 6, 1, 5))
    const eyeX = 0.48 * shape.radii.x,
      eyeY = center.y + 0.06 * shape.radii.y
    const eyeZ = center.z + shape.radii.z * 0.84
    for (const sign of [1, -1]) {
      this.add(ball, white, new Vector3(sign * eyeX, eyeY, eyeZ - 0.003 * s), new Vector3(0.0135, 0.0098, 0.0115).multiplyScalar(s))
      this.add(ball, dark, new Vector3(sign * eyeX, eyeY, eyeZ + 0.0048 * s), new Vector3(0.0056, 0.0056, 0.0042).multiplyScalar(s))
      const lid = this.add(cap, skin, new Vector3(sign * eyeX, eyeY, eyeZ - 0.003 * s), new Vector3(0.0148, 0.0112, 0.0128).multiplyScalar(s))
      this.lids.push(lid)
      const brow = this.add(
        bar,
        brown,
        new Vector3(sign * eyeX * 1.02, eyeY + 0.0215 * s, eyeZ + 0.003 * s),
        new Vector3(0.0026, 0.0032, 0.0026).multiplyScalar(s),
      )
      this.brows.push(brow)
    }
    this.browHeight = this.brows[0].position.y
    const mouthAt = new Vector3(0, center.y - 0.5 * shape.radii.y, center.z + shape.radii.z * 0.795)
    this.lips = this.add(ball, red, mouthAt, new Vector3(0.022, 0.0058, 0.008).multiplyScalar(s))
    this.mouth = this.add(ball, hollow, mouthAt.clone().add(new Vector3(0, 0, 0.0034 * s)), new Vector3(0.017, 0.0008, 0.006).multiplyScalar(s))
    this.show(undefined)
  }

  /** Moves the face; without a pose it is neutral. Allocates nothing. */
  show(pose: Pose | undefined): void {
    const w = this.weights,
      s = this.s
    for (let i = 0; i < w.length; ++i) w[i] = pose && this.tracks[i] >= 0 ? pose.tracks[this.tracks[i]] : 0
    const inner = w[kCommon],
      open = w[kCommon + 1],
      pucker = Math.max(w[kCommon + 2], w[kCommon + 3])
    let wide = 0
    for (let side = 0; side < 2; ++side) {
      const at = side * kOfSide.length // blink, squint, wide, down, up, smile, stretch
      const shut = Math.min(1, w[at] + 0.4 * w[at + 1]) - 0.5 * w[at + 2]
      this.lids[side].rotation.x = -1.05 + 1.95 * shut
      const down = w[at + 3],
        up = w[at + 4]
      this.brows[side].position.y = this.browHeight + s * (0.0055 * (up + inner) - 0.006 * down)
      const tilt = -0.02 + 0.3 * inner - 0.3 * up - 0.25 * down
      this.brows[side].rotation.z = Math.PI / 2 + (side === 0 ? -1 : 1) * tilt
      wide += 0.5 * (w[at + 5] + w[at + 6])
    }
    const width = 1 + 0.35 * wide - 0.5 * pucker
    this.lips.scale.set(0.022 * s * width, s * (0.0058 + 0.014 * open + 0.004 * pucker), s * (0.008 + 0.005 * pucker))
    this.mouth.scale.set(0.0175 * s * width, s * (0.0008 + 0.012 * open + 0.003 * pucker), s * (0.006 + 0.004 * pucker))
  }

  dispose(): void {
    for (const one of this.owned) one.dispose()
  }

  private own<T extends { dispose(): void }>(one: T): T {
    this.owned.push(one)
    return one
  }
  private material(color: number): MeshLambertMaterial {
    return this.own(new MeshLambertMaterial({ color }))
  }
  private add(geometry: Mesh['geometry'], material: MeshLambertMaterial, at: Vector3, scale: Vector3): Mesh {
    const mesh = new Mesh(geometry, material)
    mesh.position.copy(at)
    mesh.scale.copy(scale)
    this.object.add(mesh)
    return mesh
  }
}

/** Returns the rotation that takes x, y, z to the signer's left, up and front. */
function facing(p: Proportions): Quaternion {
  const m = new Vector3(0, 0, 1)
  const turn = new Quaternion().setFromUnitVectors(m, p.front)
  const up = new Vector3(0, 1, 0).applyQuaternion(turn)
  return new Quaternion().setFromUnitVectors(up, p.up).multiply(turn)
}
