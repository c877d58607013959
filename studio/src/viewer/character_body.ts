import type { Group, Object3D, SkinnedMesh } from 'three'
import type { Pose } from '../motion/pose'
import type { Skeleton } from '../motion/skeleton'
import type { Body } from './body'

interface Morph {
  readonly influences: number[]
  readonly target: number
  readonly track: number
}

/**
 * A skinned character. Poses can be applied directly: local rotations of its own joints, matched by name (`userData.joint`); face weights go to morph targets
 * of the same names (ARKit's).
 */
export class CharacterBody implements Body {
  readonly hasFace: boolean
  readonly shines = true
  private readonly joints: (Object3D | undefined)[]
  private readonly morphs: Morph[] = []
  private readonly moved: ReadonlySet<number>

  /** `release` returns the surfaces, which may be shared. Throws if the motion moves none of its joints. */
  constructor(
    readonly object: Group,
    skeleton: Skeleton,
    private readonly release: () => void,
  ) {
    const names = new Map<string, Object3D>()
    object.traverse((one) => {
      const name = one.userData.joint as string | undefined
      if (name !== undefined && !(one as SkinnedMesh).isMesh) names.set(name, one)
    })
    this.joints = skeleton.joints.map(({ name }) => names.get(name))
    this.moved = new Set(skeleton.translated)
    if (!this.joints.some(Boolean)) throw new Error('this character has none of the motion’s joints')
    object.traverse((one) => {
      const mesh = one as SkinnedMesh
      if (!mesh.isMesh) return
      skeleton.tracks.forEach((name, track) => {
        const target = mesh.morphTargetDictionary?.[name]
        if (target !== undefined) this.morphs.push({ influences: mesh.morphTargetInfluences!, target, track })
      })
    })
    this.hasFace = this.morphs.length > 0
  }

  show(pose: Pose): void {
    for (let j = 0; j < this.joints.length; ++j) {
      const joint = this.joints[j]
      if (!joint) continue
      joint.quaternion.set(pose.rotations[4 * j], pose.rotations[4 * j + 1], pose.rotations[4 * j + 2], pose.rotations[4 * j + 3])
      if (this.moved.has(j)) joint.position.set(pose.positions[3 * j], pose.positions[3 * j + 1], pose.positions[3 * j + 2])
    }
    for (let m = 0; m < this.morphs.length; ++m) {
      const morph = this.morphs[m]
      morph.influences[morph.target] = pose.tracks[morph.track]
    }
  }

  dispose(): void {
    this.object.traverse((one) => void ((one as SkinnedMesh).isSkinnedMesh && (one as SkinnedMesh).skeleton.dispose()))
    this.release()
  }
}
