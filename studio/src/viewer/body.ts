import type { Object3D } from 'three'
import type { Pose } from '../motion/pose'

/** A signer on the screen. Poses are for its own joints: the caller of `show` passes those of the skeleton it was created for. */
export interface Body {
  readonly object: Object3D
  /** Whether tracks of the motion move its face. Otherwise the face is neutral and the screen says so. */
  readonly hasFace: boolean
  /** Whether it has realistic surfaces (skin, cloth, eyes), which need different lighting. */
  readonly shines: boolean
  /** Takes a pose. Allocates nothing. */
  show(pose: Pose): void
  dispose(): void
}
