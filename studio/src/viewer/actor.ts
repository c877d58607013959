import { Scene, Vector3 } from 'three'
import { Kinematics } from '../motion/kinematics'
import type { Pose } from '../motion/pose'
import type { Body } from './body'
import { DrawnBody } from './drawn_body'
import type { Facing } from './facing'
import { Lights } from './lights'
import type { Proportions } from './proportions'
import type { Detail } from './solids'

/** A signer that plays many motions of one skeleton, one after the other within a frame: its graphics resources exist once. */
export class Actor {
  readonly scene = new Scene()
  readonly model: Kinematics
  body: Body
  /** The number of cells that use it. */
  users = 0
  private readonly lights: Lights
  private readonly root = new Vector3()

  constructor(
    readonly signer: Proportions,
    facing: Facing,
    detail: Detail,
  ) {
    this.model = new Kinematics(signer.skeleton)
    this.body = new DrawnBody(signer, detail)
    this.lights = new Lights(this.scene, facing)
    this.lights.suit(false)
    this.scene.add(this.body.object)
  }

  /** Replaces the body; the previous one is disposed. */
  wear(body: Body): void {
    this.scene.remove(this.body.object)
    this.body.dispose()
    this.body = body
    this.scene.add(body.object)
    this.lights.suit(body.shines)
  }

  /** Takes a pose for the next frame. Allocates nothing. */
  show(pose: Pose): void {
    this.model.update(pose)
    this.body.show(pose)
    const at = 3 * Math.max(0, this.signer.joint('pelvis')),
      { positions } = this.model
    this.lights.follow(this.root.set(positions[at], positions[at + 1], positions[at + 2]))
  }

  dispose(): void {
    this.body.dispose()
    this.lights.dispose()
  }
}
