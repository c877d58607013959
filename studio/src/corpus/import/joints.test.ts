import { expect, it } from 'vitest'
import { bvhJoints, jointsOf } from './joints'

it('reads joints of BVH, with blanks in their names, and none of the numbers', async () => {
  const text = 'HIERARCHY\r\nROOT Hips\r\n{\r\n JOINT Left Hand \r\n {\r\n End Site\r\n}\r\nMOTION\r\nFrames: 1\r\nJOINT no\r\n'
  expect(bvhJoints(text)).toEqual(['Hips', 'Left Hand'])
  expect(await jointsOf(new File([text], 'a.bvh'), '.bvh')).toEqual(['Hips', 'Left Hand'])
})

it('reads nodes of glTF, as text and packed, and gives up quietly', async () => {
  const json = '{"nodes":[{"name":"Hips"},{},{"name":"Hips"},{"name":"Head"}]}'
  expect(await jointsOf(new File([json], 'a.gltf'), '.gltf')).toEqual(['Hips', 'Head'])
  const head = new DataView(new ArrayBuffer(20))
  head.setUint32(12, json.length, true)
  expect(await jointsOf(new File([head.buffer, json, 'rest'], 'a.glb'), '.glb')).toEqual(['Hips', 'Head'])
  expect(await jointsOf(new File(['{'], 'a.gltf'), '.gltf')).toEqual([])
  expect(await jointsOf(new File(['x'], 'a.fbx'), '.fbx')).toEqual([])
})
