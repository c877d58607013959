import { Quaternion, Vector3 } from 'three'
import { expect, it } from 'vitest'
import { blockOf } from '../motion/encode'
import { FrameStore } from '../motion/frame_store'
import { Kinematics } from '../motion/kinematics'
import { restPose } from '../motion/pose'
import type { Skeleton } from '../motion/skeleton'
import { DrawnBody } from './drawn_body'
import { Proportions } from './proportions'
import { stanceOf } from './stance'

/** Collars at whose rest both arms point to the front, as some exporters write them: rotated outward by 90 degrees, they match a person's. */
const kFolded: Skeleton = {
  joints: [
    { name: 'p', parent: -1, offset: [0, 1, 0] },
    { name: 'n', parent: 0, offset: [0, 0.5, 0] },
    { name: 'h', parent: 1, offset: [0, 0.1, 0] },
    { name: 'lc', parent: 1, offset: [0.03, -0.05, 0] },
    { name: 'l', parent: 3, offset: [0, 0, 0.15] },
    { name: 'le', parent: 4, offset: [0, 0, 0.28] },
    { name: 'lh', parent: 5, offset: [0, 0, 0.25] },
    { name: 'rc', parent: 1, offset: [-0.03, -0.05, 0] },
    { name: 'r', parent: 7, offset: [0, 0, 0.15] },
    { name: 're', parent: 8, offset: [0, 0, 0.28] },
    { name: 'rh', parent: 9, offset: [0, 0, 0.25] },
  ],
  translated: [0],
  tracks: [],
}
const kRig = {
  pelvis: { joint: 0 },
  neck: { joint: 1 },
  head: { joint: 2 },
  head_top: { joint: 2, offset: [0, 0.2, 0] as const },
  left_clavicle: { joint: 3 },
  left_upper_arm: { joint: 4 },
  left_forearm: { joint: 5 },
  left_hand: { joint: 6 },
  right_clavicle: { joint: 7 },
  right_upper_arm: { joint: 8 },
  right_forearm: { joint: 9 },
  right_hand: { joint: 10 },
}

function motion(poses: ReturnType<typeof restPose>[], length = poses.length) {
  const store = new FrameStore(kFolded, 50, kRig, length)
  if (poses.length > 0) store.put(blockOf(kFolded, poses, 0))
  return { store, rig: kRig }
}
/** Both collars rotated outward; alternates between the two quaternions of the same rotation. */
function outward(k: number) {
  const pose = restPose(kFolded),
    sign = k % 2 ? -1 : 1
  for (const [joint, angle] of [
    [3, 1],
    [7, -1],
  ]) {
    const { x, y, z, w } = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), (angle * Math.PI) / 2 + 0.1 * Math.sin(k))
    pose.rotations.set([sign * x, sign * y, sign * z, sign * w], 4 * joint)
  }
  return pose
}

it('is the rest pose if it is plausible for a person, or if nothing is loaded', () => {
  expect(stanceOf(motion([restPose(kFolded)]))).toEqual(restPose(kFolded))
  expect(stanceOf(motion([], 10))).toEqual(restPose(kFolded))
})

it('is the captured pose if the rest pose is not plausible', () => {
  const stance = stanceOf(motion(Array.from({ length: 100 }, (_, k) => outward(k))))
  const signer = new Proportions(kFolded, kRig, stance)
  expect(signer.scale).toBeCloseTo(0.36 / 0.35, 1)
  expect(signer.left.distanceTo(new Vector3(1, 0, 0))).toBeLessThan(0.1)
  expect(signer.front.distanceTo(new Vector3(0, 0, 1))).toBeLessThan(0.1)
})

it('draws a body that matches its joints, however they were rotated when it was created', () => {
  const poses = Array.from({ length: 10 }, (_, k) => outward(k)),
    signer = new Proportions(kFolded, kRig, stanceOf(motion(poses)))
  const body = new DrawnBody(signer),
    model = new Kinematics(kFolded)
  body.show(poses[3])
  model.update(poses[3])
  body.object.updateMatrixWorld(true)
  const mesh = body.object.children.find((one) => 'isSkinnedMesh' in one) as import('three').SkinnedMesh
  mesh.skeleton.update()
  // Among the vertices attached to one joint only, the nearest is within the thickness of flesh.
  const places = mesh.geometry.getAttribute('position'),
    carriers = mesh.geometry.getAttribute('skinIndex'),
    at = new Vector3()
  const nearest = kFolded.joints.map(() => Infinity)
  for (let v = 0; v < places.count; ++v) {
    const j = carriers.getX(v)
    mesh.applyBoneTransform(v, at.fromBufferAttribute(places, v))
    nearest[j] = Math.min(nearest[j], at.distanceTo(new Vector3().fromArray(model.positions, 3 * j)))
  }
  for (const j of [4, 5, 6, 8, 9, 10]) expect(nearest[j]).toBeLessThan(0.1)
  body.dispose()
})
