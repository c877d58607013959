import { Texture, type Group, type Material, type Mesh, type Object3D, type SkinnedMesh } from 'three'
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js'
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js'
import type { Pose } from '../motion/pose'
import type { Skeleton } from '../motion/skeleton'
import type { Body } from './body'

interface Morph { readonly influences: number[]; readonly target: number; readonly track: number }

/**
 * A skinned character out of a GLB (meshopt-compressed or plain). Poses are ready to apply: local rotations of the GLB's own
 * joints, found by name; face weights go to morph targets of the same names (ARKit's).
 */
export class CharacterBody implements Body {
  readonly object: Group
  readonly hasFace: boolean
  readonly shines: boolean
  private readonly joints: (Object3D | undefined)[]
  private readonly morphs: Morph[] = []
  private readonly moved: ReadonlySet<number>

  private constructor(scene: Group, names: ReadonlyMap<string, Object3D>, skeleton: Skeleton) {
    this.object = scene
    this.joints = skeleton.joints.map(({ name }) => names.get(name))
    this.moved = new Set(skeleton.translated)
    if (!this.joints.some(Boolean)) throw new Error('this character has none of the joints that the motion moves')
    let textured = false
    scene.traverse((one) => {
      const mesh = one as SkinnedMesh
      if (!mesh.isMesh) return
      // What is blended (lashes, then the soft ends of hair) is drawn after what is not, and throws no shadow of its outline.
      const blended = materialsOf(mesh).some(({ transparent }) => transparent)
      mesh.renderOrder = mesh.name === 'hairEdge' ? 2 : blended ? 1 : 0
      mesh.castShadow = !blended
      mesh.receiveShadow = true
      mesh.frustumCulled = false
      textured ||= materialsOf(mesh).some((material) => texturesOf(material).length > 0)
      skeleton.tracks.forEach((name, track) => {
        const target = mesh.morphTargetDictionary?.[name]
        if (target !== undefined) this.morphs.push({ influences: mesh.morphTargetInfluences!, target, track })
      })
    })
    this.hasFace = this.morphs.length > 0
    this.shines = textured
  }

  static async load(glb: ArrayBuffer, skeleton: Skeleton): Promise<CharacterBody> {
    const loader = new GLTFLoader()
    loader.setMeshoptDecoder(MeshoptDecoder)
    const gltf = await loader.parseAsync(glb, '')
    // The loader takes dots and blanks out of names: the file's own are in its JSON.
    const names = new Map<string, Object3D>()
    const nodes = (gltf.parser.json as { nodes?: { name?: string }[] }).nodes ?? []
    for (const [object, where] of gltf.parser.associations) {
      const node = (where as { nodes?: number } | undefined)?.nodes
      if (node !== undefined && nodes[node]?.name !== undefined) names.set(nodes[node].name, object as Object3D)
    }
    return new CharacterBody(gltf.scene, names, skeleton)
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
    const textures = new Set<Texture>()
    this.object.traverse((one) => {
      const mesh = one as SkinnedMesh
      if (!mesh.isMesh) return
      mesh.geometry.dispose()
      if (mesh.isSkinnedMesh) mesh.skeleton.dispose()
      for (const material of materialsOf(mesh)) {
        for (const texture of texturesOf(material)) textures.add(texture)
        material.dispose()
      }
    })
    for (const texture of textures) {
      texture.dispose()
      if (texture.image instanceof ImageBitmap) texture.image.close()
    }
  }
}

function materialsOf(mesh: Mesh): readonly Material[] {
  return ([] as Material[]).concat(mesh.material)
}

function texturesOf(material: Material): Texture[] {
  return Object.values(material).filter((value): value is Texture => value instanceof Texture)
}
