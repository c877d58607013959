import { frameBytes, kMessageHeaderBytes, kRotationUnit, kTranslationUnit, type FrameBlock } from './frames'
import type { Pose } from './pose'
import type { Skeleton } from './skeleton'

/** Packs poses into a message of docs/stream.md, as a server does; for tests and for pages that show a signer at rest. */
export function encode(skeleton: Skeleton, poses: readonly Pose[], first = 0): ArrayBuffer {
  const message = new ArrayBuffer(kMessageHeaderBytes + poses.length * frameBytes(skeleton))
  const view = new DataView(message)
  view.setUint8(0, 1)
  view.setUint16(2, poses.length, true)
  view.setBigUint64(8, BigInt(first), true)
  let at = kMessageHeaderBytes
  for (const { positions, tracks, rotations } of poses) {
    for (const joint of skeleton.translated) {
      for (let k = 0; k < 3; ++k, at += 4) view.setInt32(at, Math.round(positions[3 * joint + k] / kTranslationUnit), true)
    }
    for (const track of tracks) {
      view.setFloat32(at, track, true)
      at += 4
    }
    for (const part of rotations) {
      view.setInt16(at, Math.round(part / kRotationUnit), true)
      at += 2
    }
  }
  return message
}

/** Returns the same as a block for a store. */
export function blockOf(skeleton: Skeleton, poses: readonly Pose[], first = 0): FrameBlock {
  return { first, count: poses.length, buffer: encode(skeleton, poses), offset: kMessageHeaderBytes }
}
