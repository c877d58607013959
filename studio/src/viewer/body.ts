import type { Object3D } from 'three'
import type { Pose } from '../motion/pose'

/** A signer on the screen. Poses are for its own joints: whoever calls `show` gives those of the skeleton it was made for. */
export interface Body {
  readonly object: Object3D
  /** Whether tracks of the motion move its face. Where not, the face is neutral and the screen says so. */
  readonly hasFace: boolean
  /** Whether it has surfaces of its own (skin, cloth, eyes), which want a light of their own. */
  readonly shines: boolean
  /** Takes a pose. Allocates nothing. */
  show(pose: Pose): void
  dispose(): void
}
