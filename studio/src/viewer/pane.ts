import { Scene, Vector3 } from 'three'
import type { FrameStore } from '../motion/frame_store'
import { Kinematics } from '../motion/kinematics'
import { restPose, type Pose } from '../motion/pose'
import type { OpenedMotion } from '../motion/source'
import type { Body } from './body'
import { BonesOverlay } from './bones_overlay'
import { SignerCamera } from './camera'
import { DrawnBody } from './drawn_body'
import { Lights } from './lights'
import { facingOf, type Facing } from './facing'
import { Proportions } from './proportions'
import { stanceOf } from './stance'
import { Trails } from './trails'

/** One motion on the stage: its signer, light and camera. */
export class Pane {
  readonly scene = new Scene()
  readonly store: FrameStore
  readonly signer: Proportions
  readonly facing: Facing
  readonly camera: SignerCamera
  /** The cameras of the picture: the main one, or close-ups of each hand, the right one first, as seen from the front. */
  cameras: readonly SignerCamera[]
  body: Body
  /** Maps the stage's time to this motion's, both in seconds; identity by default. */
  timeOf: (seconds: number) => number = (seconds) => seconds
  /** The pane whose cameras are used; its own by default. That pane must be drawn first. */
  lead?: Pane
  /** Whether the last picture lacked frames, so that it must be redrawn when more arrive. */
  waiting = true
  /** Whether its signer has been drawn. */
  seen = false
  private readonly pose: Pose
  private readonly model: Kinematics
  private readonly trails: Trails
  private readonly bones: BonesOverlay
  private readonly lights: Lights
  private readonly alone: readonly SignerCamera[]
  private readonly hands: readonly SignerCamera[]
  private readonly root = new Vector3()

  constructor(readonly motion: OpenedMotion) {
    this.store = motion.store
    const { skeleton } = motion.store
    this.signer = new Proportions(skeleton, motion.rig, stanceOf(motion))
    this.facing = facingOf(motion, this.signer)
    this.camera = new SignerCamera(this.signer, this.facing)
    this.cameras = this.alone = [this.camera]
    this.hands =
      motion.store.hasHand[0] && motion.store.hasHand[1] ? [new SignerCamera(this.signer, this.facing, 1), new SignerCamera(this.signer, this.facing, 0)] : []
    this.pose = restPose(skeleton)
    this.model = new Kinematics(skeleton)
    this.trails = new Trails(motion.store)
    this.bones = new BonesOverlay(skeleton, this.model)
    this.body = new DrawnBody(this.signer)
    this.lights = new Lights(this.scene, this.facing)
    this.lights.suit(false)
    this.scene.add(this.body.object, this.trails.object, this.bones.object)
    this.trails.object.visible = this.bones.object.visible = false
  }

  set trailsShown(shown: boolean) {
    this.trails.object.visible = shown
  }
  set bonesShown(shown: boolean) {
    this.bones.object.visible = shown
  }

  /** Replaces the body; the previous one is disposed. */
  wear(body: Body): void {
    this.scene.remove(this.body.object)
    this.body.dispose()
    this.body = body
    this.scene.add(body.object)
    this.lights.suit(body.shines)
  }

  /** Updates everything to a time of the stage, in seconds. */
  update(seconds: number): void {
    const time = this.timeOf(seconds)
    const { store, model } = this
    store.sample(time, this.pose)
    this.waiting = !store.has(Math.min(store.length - 1, Math.floor(time * store.rate + 1e-6)))
    model.update(this.pose)
    this.body.show(this.pose)
    if (this.trails.object.visible) this.trails.update(time)
    if (this.bones.object.visible) this.bones.update()
    this.cameras = this.lead ? this.lead.cameras : this.camera.view === 'hands' && this.hands.length > 0 ? this.hands : this.alone
    const root = 3 * Math.max(0, this.signer.joint('pelvis'))
    this.lights.follow(this.root.set(model.positions[root], model.positions[root + 1], model.positions[root + 2]))
  }

  /** Moves one of the cameras for a picture with this aspect ratio, `elapsed` seconds after the previous one. */
  aim(camera: SignerCamera, aspect: number, elapsed: number): void {
    if (this.lead) return
    if (camera !== this.camera) camera.like(this.camera)
    camera.update(this.model, aspect, elapsed)
  }

  dispose(): void {
    this.body.dispose()
    this.trails.dispose()
    this.bones.dispose()
    this.lights.dispose()
  }
}
