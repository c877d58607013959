import { Texture, type Group, type Material, type Mesh, type Object3D, type Skeleton as Bones, type SkinnedMesh } from 'three'
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js'
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js'
import { clone } from 'three/addons/utils/SkeletonUtils.js'
import type { Skeleton } from '../motion/skeleton'
import { CharacterBody } from './character_body'

/** The content of a character's GLB (meshopt-compressed or plain), parsed once, for any number of signers on the screen. */
export class CharacterModel {
  private constructor(private readonly scene: Group) {}

  static async load(glb: ArrayBuffer): Promise<CharacterModel> {
    const loader = new GLTFLoader()
    loader.setMeshoptDecoder(MeshoptDecoder)
    const { scene, parser } = await loader.parseAsync(glb, '')
    // The loader removes dots and spaces from names: the original ones are in the file's JSON.
    const nodes = (parser.json as { nodes?: { name?: string }[] }).nodes ?? []
    for (const [object, where] of parser.associations) {
      const node = (where as { nodes?: number } | undefined)?.nodes
      if (node !== undefined && nodes[node]?.name !== undefined) (object as Object3D).userData.joint = nodes[node].name
    }
    scene.traverse((one) => {
      const mesh = one as SkinnedMesh
      if (!mesh.isMesh) return
      // Blended materials (lashes, then the soft ends of hair) are drawn after opaque ones, and cast no shadow of their outline.
      const blended = materialsOf(mesh).some(({ transparent }) => transparent)
      mesh.renderOrder = mesh.name === 'hairEdge' ? 2 : blended ? 1 : 0
      mesh.castShadow = !blended
      mesh.receiveShadow = true
      mesh.frustumCulled = false
    })
    return new CharacterModel(scene)
  }

  /** Creates a signer with this model, for poses of `skeleton`. */
  body(skeleton: Skeleton): CharacterBody {
    return new CharacterBody(this.copy(), skeleton, () => this.release())
  }

  /** Joints and meshes are copied; surfaces, and the skin of meshes that share one, stay shared. */
  private copy(): Group {
    const copy = clone(this.scene) as Group
    const mine: SkinnedMesh[] = [],
      own: SkinnedMesh[] = []
    this.scene.traverse((one) => void ((one as SkinnedMesh).isSkinnedMesh && mine.push(one as SkinnedMesh)))
    copy.traverse((one) => void ((one as SkinnedMesh).isSkinnedMesh && own.push(one as SkinnedMesh)))
    const skins = new Map<Bones, Bones>()
    own.forEach((mesh, m) => {
      const shared = skins.get(mine[m].skeleton)
      if (shared) mesh.bind(shared, mesh.bindMatrix)
      else skins.set(mine[m].skeleton, mesh.skeleton)
    })
    return copy
  }

  /** Releases its graphics resources; they are uploaded again when it is drawn again. */
  private release(): void {
    const textures = new Set<Texture>()
    this.scene.traverse((one) => {
      const mesh = one as Mesh
      if (!mesh.isMesh) return
      mesh.geometry.dispose()
      for (const material of materialsOf(mesh)) {
        for (const texture of texturesOf(material)) textures.add(texture)
        material.dispose()
      }
    })
    for (const texture of textures) texture.dispose()
  }
}

function materialsOf(mesh: Mesh): readonly Material[] {
  return ([] as Material[]).concat(mesh.material)
}

function texturesOf(material: Material): Texture[] {
  return Object.values(material).filter((value): value is Texture => value instanceof Texture)
}
