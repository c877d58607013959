import { expect, it } from 'vitest'
import { isSoftware, Pace } from './pace'

function rig() {
  const gl = {
    SYNC_STATUS: 1,
    SIGNALED: 2,
    SYNC_GPU_COMMANDS_COMPLETE: 3,
    done: false,
    deleted: 0,
    fenceSync: () => ({}),
    flush: () => {},
    isContextLost: () => false,
    deleteSync: () => void ++gl.deleted,
    getSyncParameter: () => (gl.done ? 2 : 0),
  }
  return { gl, pace: new Pace(gl as unknown as WebGL2RenderingContext) }
}

it('requests no frame before the last is drawn', () => {
  const { gl, pace } = rig()
  expect(pace.ready(0)).toBe(true)
  pace.drew(0)
  expect(pace.ready(16)).toBe(false)
  gl.done = true
  expect(pace.ready(32)).toBe(true)
  expect(gl.deleted).toBe(1)
})

it('rests after a slow frame', () => {
  const { gl, pace } = rig()
  pace.drew(0)
  gl.done = true
  expect(pace.ready(200)).toBe(false)
  expect(pace.ready(290)).toBe(false)
  expect(pace.ready(301)).toBe(true)
})

it('recognizes software renderers', () => {
  for (const name of ['ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)), SwiftShader driver)', 'llvmpipe (LLVM 15)', 'Microsoft Basic Render Driver'])
    expect(isSoftware(name), name).toBe(true)
  for (const name of ['ANGLE (Intel, Mesa Intel(R) UHD Graphics 620)', 'Apple GPU']) expect(isSoftware(name), name).toBe(false)
})
