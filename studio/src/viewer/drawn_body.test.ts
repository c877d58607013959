import { SkinnedMesh, Vector3 } from 'three'
import { expect, it } from 'vitest'
import { restPose } from '../motion/pose'
import type { Skeleton } from '../motion/skeleton'
import { DrawnBody } from './drawn_body'
import { Proportions } from './proportions'

/** A signer who lies along x and faces up, so that no direction is taken for granted. */
const kLying: Skeleton = {
  joints: [
    { name: 'p', parent: -1, offset: [0, 1, 0] },
    { name: 'n', parent: 0, offset: [0.5, 0, 0] },
    { name: 'h', parent: 1, offset: [0.1, 0, 0] },
    { name: 'l', parent: 1, offset: [-0.05, 0, 0.2] },
    { name: 'le', parent: 3, offset: [0, 0, 0.28] },
    { name: 'lh', parent: 4, offset: [0, 0, 0.25] },
    { name: 'r', parent: 1, offset: [-0.05, 0, -0.2] },
    { name: 're', parent: 6, offset: [0, 0, -0.28] },
    { name: 'rh', parent: 7, offset: [0, 0, -0.25] },
  ],
  translated: [0],
  tracks: [],
}
const kRig = {
  pelvis: { joint: 0 },
  neck: { joint: 1 },
  head: { joint: 2 },
  left_upper_arm: { joint: 3 },
  left_forearm: { joint: 4 },
  left_hand: { joint: 5 },
  right_upper_arm: { joint: 6 },
  right_forearm: { joint: 7 },
  right_hand: { joint: 8 },
}

it('determines up, left and front from the skeleton alone', () => {
  const p = new Proportions(kLying, kRig)
  expect(p.up.distanceTo(new Vector3(1, 0, 0))).toBeLessThan(1e-6)
  expect(p.left.distanceTo(new Vector3(0, 0, 1))).toBeLessThan(1e-6)
  expect(p.front.distanceTo(new Vector3(0, 1, 0))).toBeLessThan(1e-6)
  expect(p.scale).toBeCloseTo(0.4 / 0.35)
})

it('draws a body that moves with its joints, with outward faces, and reports that its face is neutral', () => {
  const body = new DrawnBody(new Proportions(kLying, kRig))
  expect(body.hasFace).toBe(false)
  const pose = restPose(kLying)
  pose.positions.set([0, 3, 0], 0)
  body.show(pose)
  body.object.updateMatrixWorld(true)
  const mesh = body.object.children.find((one): one is SkinnedMesh => (one as SkinnedMesh).isSkinnedMesh)!
  mesh.skeleton.update()
  const places = mesh.geometry.getAttribute('position'),
    normals = mesh.geometry.getAttribute('normal')
  const at = new Vector3(),
    normal = new Vector3()
  let low = Infinity,
    volume = 0
  for (let v = 0; v < places.count; ++v) {
    mesh.applyBoneTransform(v, at.fromBufferAttribute(places, v))
    low = Math.min(low, at.y)
  }
  expect(low).toBeGreaterThan(2.5)
  const index = mesh.geometry.index!,
    a = new Vector3(),
    b = new Vector3(),
    c = new Vector3()
  for (let i = 0; i < index.count; i += 3) {
    a.fromBufferAttribute(places, index.getX(i))
    b.fromBufferAttribute(places, index.getX(i + 1))
    c.fromBufferAttribute(places, index.getX(i + 2))
    volume += a.dot(b.cross(c)) / 6
  }
  expect(volume).toBeGreaterThan(0.02)
  expect(normal.fromBufferAttribute(normals, 0).length()).toBeCloseTo(1, 3)
  body.dispose()
})

it('draws bones if the rig map is empty', () => {
  const body = new DrawnBody(new Proportions(kLying, {}))
  const mesh = body.object.children.find((one): one is SkinnedMesh => (one as SkinnedMesh).isSkinnedMesh)!
  expect(mesh.geometry.getAttribute('position').count).toBeGreaterThan(100)
  body.dispose()
})
