// The page driven by character.mjs: the studio's own stage, pane and character, with a motion of a few still frames.
import type { Mesh } from 'three'
import { blockOf } from '../../../src/motion/encode'
import { FrameStore } from '../../../src/motion/frame_store'
import { restPose } from '../../../src/motion/pose'
import type { Rig, Skeleton } from '../../../src/motion/skeleton'
import { CharacterModel } from '../../../src/viewer/character_model'
import { Pane } from '../../../src/viewer/pane'
import { Stage } from '../../../src/viewer/stage'
import { Transport } from '../../../src/viewer/transport'

interface Node {
  name?: string
  children?: number[]
  translation?: [number, number, number]
}
interface Gltf {
  nodes: Node[]
  skins: { joints: number[] }[]
  meshes: { extras?: { targetNames?: string[] } }[]
  asset: { extras: { signweave: { height: number } } }
}

/** Maps parts to joints, like the rig map of the character. */
const kParts: Record<string, string> = {
  pelvis: 'spine05',
  neck: 'neck01',
  head: 'head',
  left_clavicle: 'clavicle_L',
  right_clavicle: 'clavicle_R',
  left_upper_arm: 'upperarm01_L',
  right_upper_arm: 'upperarm01_R',
  left_forearm: 'lowerarm01_L',
  right_forearm: 'lowerarm01_R',
  left_hand: 'wrist_L',
  right_hand: 'wrist_R',
  left_foot: 'foot_L',
  right_foot: 'foot_R',
}
/** One still frame each: weights by ARKit's names. */
const kFaces: readonly Record<string, number>[] = [
  {},
  { mouthSmileLeft: 0.8, mouthSmileRight: 0.8, cheekSquintLeft: 0.4, cheekSquintRight: 0.4 },
  { eyeBlinkLeft: 1, eyeBlinkRight: 1 },
  { browInnerUp: 1, browOuterUpLeft: 1, browOuterUpRight: 1, jawOpen: 0.5 },
]

function jsonOf(glb: ArrayBuffer): Gltf {
  const length = new DataView(glb).getUint32(12, true)
  return JSON.parse(new TextDecoder().decode(new Uint8Array(glb, 20, length))) as Gltf
}

/** Returns the joints of a character, with its weights as tracks. */
function skeletonOf({ nodes, skins, meshes }: Gltf): Skeleton {
  const joints = skins[0].joints
  const parentOf = (joint: number) => joints.findIndex((j) => nodes[j].children?.includes(joint))
  return {
    joints: joints.map((j) => ({ name: nodes[j].name!, parent: parentOf(j), offset: nodes[j].translation ?? [0, 0, 0] })),
    translated: joints.flatMap((j, at) => (parentOf(j) < 0 ? [at] : [])),
    tracks: [...new Set(meshes.flatMap(({ extras }) => extras?.targetNames ?? []))],
  }
}

const canvas = document.querySelector('canvas')!
const transport = new Transport()
const stage = new Stage(canvas, transport)

async function wear(url: string): Promise<{ ms: number; tracks: number }> {
  const glb = await (await fetch(url)).arrayBuffer()
  const gltf = jsonOf(glb)
  const skeleton = skeletonOf(gltf)
  const at = (name: string) => ({ joint: skeleton.joints.findIndex((joint) => joint.name === name) })
  const rig: Rig = Object.fromEntries(Object.entries(kParts).map(([part, name]) => [part, at(name)]))
  const store = new FrameStore(skeleton, 10, rig)
  store.put(
    blockOf(
      skeleton,
      kFaces.map((face) => {
        const pose = restPose(skeleton)
        skeleton.tracks.forEach((name, track) => (pose.tracks[track] = face[name] ?? 0))
        return pose
      }),
    ),
  )
  const pane = new Pane({ store, rig, originMs: 0, declarations: {} })
  pane.camera.look('front')
  const start = performance.now()
  pane.wear((await CharacterModel.load(glb)).body(skeleton))
  stage.panes.push(pane)
  transport.duration = store.seconds
  stage.touch()
  return { ms: Math.round(performance.now() - start), tracks: skeleton.tracks.length }
}

/** Removes the signer from the stage; returns what the graphics card still holds. */
function clear() {
  for (const pane of stage.panes.splice(0)) pane.dispose()
  stage.touch()
  return { ...stage.held }
}

/** Returns each mesh's name, its position in the drawing order, and the names of weights that are not 0. */
function meshes() {
  const found: { name: string; order: number; moved: string[] }[] = []
  stage.panes[0]?.body.object.traverse((one) => {
    const mesh = one as Mesh
    if (!mesh.isMesh) return
    const names = Object.entries(mesh.morphTargetDictionary ?? {})
    found.push({ name: mesh.name, order: mesh.renderOrder, moved: names.flatMap(([name, at]) => (mesh.morphTargetInfluences![at] ? [name] : [])) })
  })
  return found
}

Object.assign(window, { wear, clear, meshes, stage, transport })
