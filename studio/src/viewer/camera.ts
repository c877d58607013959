import { PerspectiveCamera, Vector3 } from 'three'
import type { Kinematics } from '../motion/kinematics'
import type { Facing } from './facing'
import type { Proportions } from './proportions'

export const kViews = ['front', 'left', 'right', 'hands', 'face', 'whole'] as const
export type View = (typeof kViews)[number]

const kLens = 28 // degrees, vertical: narrow enough that hands in front of the body are not enlarged

/** The time constant of the camera in seconds: it covers two thirds of the distance. */
const kFollow = 0.13

/** From a wrist to beyond the fingertips, metres of a signer of scale 1. */
const kHand = 0.19
/** How far down a relaxed hanging arm reaches, as a fraction of its length. */
const kHang = 0.9

/** Frames the signer as sign language is filmed: from the hips, or from the hands of hanging arms, to above the head; hands stay in view. */
export class SignerCamera {
  readonly camera = new PerspectiveCamera(kLens, 1, 0.05, 50)
  /** Radians about the vertical from the front, to the signer's left; and up. */
  azimuth = 0
  elevation = 0
  /** Magnification relative to the view's default. */
  zoom = 1
  view: View = 'front'
  private readonly target = new Vector3()
  private readonly wanted = new Vector3()
  private readonly offset = new Vector3()
  private readonly along = new Vector3()
  private distance = 1
  /** Metres missing from the current distance. */
  private away = 0
  private fresh = true
  private readonly height: number
  private readonly half: { width: number; height: number }
  private readonly wholeHeight: number
  private readonly wholeHalf: number
  private readonly wrists: readonly [number, number]
  private readonly root: number
  private readonly head: number
  /** From the head's joint to the middle of the face, metres. */
  private readonly toFace: number

  private readonly knuckles: number

  /** With a hand (0 left, 1 right), the view of the hands shows only that one. */
  constructor(
    private readonly signer: Proportions,
    private readonly facing: Facing,
    hand?: 0 | 1,
  ) {
    const at = (part: string) => signer.at(part)?.dot(signer.up)
    const feet = Math.min(at('left_foot') ?? 0, at('right_foot') ?? 0)
    const pelvis = at('pelvis') ?? 0.9 * signer.scale
    const top = at('head_top') ?? (at('head') ?? pelvis + 0.6 * signer.scale) + 0.19 * signer.scale
    // Relative to the pelvis, which the camera follows slowly and horizontally.
    const low = Math.min(-0.16 * signer.scale, this.hanging() - pelvis),
      high = top - pelvis + 0.13 * signer.scale
    this.height = (low + high) / 2
    this.half = { width: 0.56 * signer.scale, height: (high - low) / 2 }
    this.wholeHeight = (feet - pelvis - 0.13 * signer.scale + high) / 2
    this.wholeHalf = (high - (feet - pelvis - 0.13 * signer.scale)) / 2
    this.wrists = [signer.joint('left_hand'), signer.joint('right_hand')]
    const middle = hand === undefined ? -1 : signer.joint(hand === 0 ? 'left_middle_proximal' : 'right_middle_proximal')
    this.knuckles = hand === undefined ? -1 : middle >= 0 ? middle : this.wrists[hand]
    this.root = Math.max(0, signer.joint('pelvis'))
    this.head = signer.joint('head')
    this.toFace = 0.42 * Math.max(0.12 * signer.scale, top - (at('head') ?? top - 0.19 * signer.scale))
  }

  /** Returns the height of the fingertips of hanging arms, along up. */
  private hanging(): number {
    const { signer } = this
    const low = (['left', 'right'] as const).flatMap((side) => {
      const [shoulder, elbow, wrist] = ['upper_arm', 'forearm', 'hand'].map((part) => signer.at(`${side}_${part}`))
      return shoulder && elbow && wrist ? [shoulder.dot(signer.up) - kHang * (shoulder.distanceTo(elbow) + elbow.distanceTo(wrist)) - kHand * signer.scale] : []
    })
    return Math.min(Infinity, ...low)
  }

  look(view: View): void {
    this.view = view
    this.zoom = 1
    this.elevation = view === 'hands' ? 0.12 : 0
    this.azimuth = view === 'left' ? Math.PI / 2 : view === 'right' ? -Math.PI / 2 : 0
    this.fresh = true
  }

  /** Adopts another camera's direction; if its own view was different, it jumps there at once. */
  like({ view, azimuth, elevation, zoom }: SignerCamera): void {
    this.fresh ||= view !== this.view
    this.view = view
    this.azimuth = azimuth
    this.elevation = elevation
    this.zoom = zoom
  }

  orbit(azimuth: number, elevation: number): void {
    this.azimuth = ((((this.azimuth + azimuth + Math.PI) % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI)) - Math.PI
    this.elevation = Math.min(1.4, Math.max(-1.2, this.elevation + elevation))
  }

  /** Moves the camera for a picture with this aspect ratio, `elapsed` seconds after the previous one; `model` must be up to date. */
  update(model: Kinematics, aspect: number, elapsed: number): void {
    const { signer, facing, wanted } = this
    const place = model.positions
    let halfHeight = this.half.height,
      halfWidth = this.half.width
    if (this.view === 'hands' && this.knuckles >= 0) {
      const at = 3 * this.knuckles
      wanted.set(place[at], place[at + 1], place[at + 2])
      halfHeight = halfWidth = 0.125 * signer.scale
    } else if (this.view === 'hands' && this.wrists[0] >= 0 && this.wrists[1] >= 0) {
      const [l, r] = this.wrists
      wanted.set(place[3 * l] + place[3 * r], place[3 * l + 1] + place[3 * r + 1], place[3 * l + 2] + place[3 * r + 2]).multiplyScalar(0.5)
      wanted.addScaledVector(facing.up, 0.04 * signer.scale)
      this.along.set(place[3 * l] - place[3 * r], place[3 * l + 1] - place[3 * r + 1], place[3 * l + 2] - place[3 * r + 2])
      halfHeight = 0.18 * signer.scale + 0.5 * Math.abs(this.along.y)
      halfWidth = 0.17 * signer.scale + 0.5 * Math.hypot(this.along.x, this.along.z)
    } else if (this.view === 'face' && this.head >= 0) {
      const head = 3 * this.head
      wanted.set(place[head], place[head + 1], place[head + 2]).addScaledVector(facing.up, this.toFace)
      halfHeight = 0.17 * signer.scale
      halfWidth = 0.14 * signer.scale
    } else {
      const root = 3 * this.root
      wanted.set(place[root], place[root + 1], place[root + 2])
      wanted.addScaledVector(facing.up, this.view === 'whole' ? this.wholeHeight : this.height)
      if (this.view === 'whole') halfHeight = this.wholeHalf
      // The view extends to hands that reach beyond it.
      for (const wrist of this.wrists) {
        if (wrist < 0) continue
        this.along.set(place[3 * wrist], place[3 * wrist + 1], place[3 * wrist + 2]).sub(wanted)
        halfHeight = Math.max(halfHeight, Math.abs(this.along.dot(facing.up)) + kHand * signer.scale)
        const aside = this.along.dot(facing.left) * Math.cos(this.azimuth) - this.along.dot(facing.front) * Math.sin(this.azimuth)
        halfWidth = Math.max(halfWidth, Math.abs(aside) + kHand * signer.scale)
      }
    }
    const lens = Math.tan((kLens * Math.PI) / 360)
    const distance = Math.max(halfHeight / lens, halfWidth / (lens * aspect)) / this.zoom + 0.15 * signer.scale
    // Follows smoothly, so that a view of the hands does not shake; the speed is independent of the frame rate.
    const follow = this.fresh ? 1 : 1 - Math.exp(-elapsed / kFollow)
    this.target.lerp(wanted, follow)
    this.distance += (distance - this.distance) * follow
    this.away = Math.abs(distance - this.distance)
    this.fresh = false
    const flat = Math.cos(this.elevation)
    this.offset
      .set(0, 0, 0)
      .addScaledVector(facing.left, Math.sin(this.azimuth) * flat)
      .addScaledVector(facing.front, Math.cos(this.azimuth) * flat)
      .addScaledVector(facing.up, Math.sin(this.elevation))
    this.camera.position.copy(this.target).addScaledVector(this.offset, this.distance)
    this.camera.up.copy(facing.up)
    this.camera.lookAt(this.target)
    if (this.camera.aspect !== aspect) {
      this.camera.aspect = aspect
      this.camera.updateProjectionMatrix()
    }
    this.camera.updateMatrixWorld()
  }

  /** Whether the camera has come to rest, so that a still picture need not be redrawn. */
  get settled(): boolean {
    return this.away < 1e-4 && this.target.distanceToSquared(this.wanted) < 1e-8
  }
}
