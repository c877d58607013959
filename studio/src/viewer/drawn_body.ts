import { Bone, type BufferGeometry, Group, Matrix4, MeshLambertMaterial, Skeleton as SkinSkeleton, SkinnedMesh } from 'three'
import type { Pose } from '../motion/pose'
import type { Body } from './body'
import { DrawnFace } from './drawn_face'
import { drawnGeometry } from './drawn_solids'
import type { Proportions } from './proportions'
import { Shared } from './shared'
import type { Detail } from './solids'

/** The geometries of the existing bodies: successive pieces of a recording share them. */
const kSurfaces = new Shared<BufferGeometry>()

/** A signer drawn from the skeleton itself: available at once, for any skeleton with any joint names. */
export class DrawnBody implements Body {
  readonly object = new Group()
  readonly hasFace: boolean
  readonly shines = false
  private readonly bones: Bone[]
  private readonly mesh: SkinnedMesh
  private readonly face?: DrawnFace
  private readonly surface: string

  constructor(proportions: Proportions, detail: Detail = 'fine') {
    const { skeleton, rig } = proportions
    this.bones = skeleton.joints.map(({ name, offset }) => {
      const bone = new Bone()
      bone.name = name
      bone.position.set(...offset)
      return bone
    })
    skeleton.joints.forEach(({ parent }, j) => (parent < 0 ? this.object : this.bones[parent]).add(this.bones[j]))
    const material = new MeshLambertMaterial({ vertexColors: true })
    this.surface = JSON.stringify([detail, rig, skeleton.joints.map(({ parent }) => parent), ...proportions.stance.rotations, ...proportions.stance.positions])
    this.mesh = new SkinnedMesh(
      kSurfaces.take(this.surface, () => drawnGeometry(proportions, detail)),
      material,
    )
    const inverses = skeleton.joints.map((_, j) => proportions.matrixOf(j).invert())
    this.mesh.bind(new SkinSkeleton(this.bones, inverses), new Matrix4())
    this.mesh.frustumCulled = false
    this.object.add(this.mesh)
    const head = proportions.joint('head')
    if (head >= 0) {
      this.face = new DrawnFace(proportions, skeleton.tracks, detail)
      this.bones[head].add(this.face.object)
    }
    this.hasFace = this.face?.moves ?? false
    this.object.traverse((one) => {
      one.castShadow = one.receiveShadow = true
    })
  }

  show(pose: Pose): void {
    for (let j = 0; j < this.bones.length; ++j) {
      this.bones[j].quaternion.set(pose.rotations[4 * j], pose.rotations[4 * j + 1], pose.rotations[4 * j + 2], pose.rotations[4 * j + 3])
      this.bones[j].position.set(pose.positions[3 * j], pose.positions[3 * j + 1], pose.positions[3 * j + 2])
    }
    this.face?.show(pose)
  }

  dispose(): void {
    kSurfaces.leave(this.surface)
    ;(this.mesh.material as MeshLambertMaterial).dispose()
    this.mesh.skeleton.dispose()
    this.face?.dispose()
  }
}
