import type { Joint, Skeleton } from './skeleton'

/** The bytes of frames, as docs/stream.md has them; all that knows the layout is here and in `FrameStore`. */
export const kMessageHeaderBytes = 16
/** Of a translation, in metres: one unit is 10 µm. */
export const kTranslationUnit = 1e-5
/** Of a rotation. */
export const kRotationUnit = 1 / 32767

/** Frames that follow each other, in the layout of docs/stream.md. */
export interface FrameBlock {
  /** Number of the first frame, from 0. */
  readonly first: number
  readonly count: number
  /** `count` frames of `frameBytes` each, from `offset` on. */
  readonly buffer: ArrayBuffer
  readonly offset: number
}

/** How many bytes a frame of this skeleton has. It is a multiple of 4. */
export function frameBytes(skeleton: Skeleton): number {
  return 12 * skeleton.translated.length + 4 * skeleton.tracks.length + 8 * skeleton.joints.length
}

/** Reads a binary message of a stream. Throws where it is not of layout 1 or not as long as it says. */
export function decodeMessage(message: ArrayBuffer, bytesOfFrame: number): FrameBlock & { leftOut: number } {
  if (message.byteLength < kMessageHeaderBytes) throw new Error('a message of frames that has no header')
  const view = new DataView(message)
  if (view.getUint8(0) !== 1) throw new Error(`frames of layout ${view.getUint8(0)}; this page knows 1`)
  const count = view.getUint16(2, true)
  if (message.byteLength !== kMessageHeaderBytes + count * bytesOfFrame) {
    throw new Error(`${count} frames of ${bytesOfFrame} bytes in a message of ${message.byteLength}`)
  }
  return {
    first: Number(view.getBigUint64(8, true)),
    count,
    buffer: message,
    offset: kMessageHeaderBytes,
    leftOut: view.getUint32(4, true),
  }
}

/** A motion as JSON, as `format=json` answers it. */
export interface MotionJson {
  readonly frames: number
  readonly frames_per_second: number
  readonly declarations?: Record<string, string>
  readonly joints: readonly { name: string; parent: number; offset: [number, number, number]; translated: boolean }[]
  /** [frame][4 · joint] */
  readonly rotations_xyzw: readonly (readonly number[])[]
  /** [frame][3 · translated joint] */
  readonly translations_m: readonly (readonly number[])[]
  /** By name, [frame]. */
  readonly tracks: Record<string, readonly number[]>
}

/** What is answered for one motion: of a recording the motion itself, of `sign` and `edit` the report that holds it. */
export type MotionAnswer = MotionJson | { readonly motion: MotionJson; readonly declarations?: Record<string, string>; readonly signs?: readonly unknown[] }

export function skeletonOfJson(json: MotionJson): Skeleton {
  const joints: Joint[] = json.joints.map(({ name, parent, offset }) => ({ name, parent, offset }))
  const translated = json.joints.flatMap((joint, j) => (joint.translated ? [j] : []))
  return { joints, translated, tracks: Object.keys(json.tracks) }
}

/** Packs a motion of JSON into the layout, its first frame numbered `first`. */
export function encodeJson(json: MotionJson, skeleton: Skeleton, first: number): FrameBlock {
  const bytes = frameBytes(skeleton)
  const buffer = new ArrayBuffer(json.frames * bytes)
  const view = new DataView(buffer)
  const tracks = skeleton.tracks.map((name) => json.tracks[name])
  for (let f = 0, at = 0; f < json.frames; ++f) {
    for (const metres of json.translations_m[f]) view.setInt32(at, Math.round(metres / kTranslationUnit), true), (at += 4)
    for (const track of tracks) view.setFloat32(at, track?.[f] ?? 0, true), (at += 4)
    for (const part of json.rotations_xyzw[f]) view.setInt16(at, Math.round(part / kRotationUnit), true), (at += 2)
    if (at !== (f + 1) * bytes) throw new Error(`frame ${f} of the motion has not the numbers that its skeleton asks for`)
  }
  return { first, count: json.frames, buffer, offset: 0 }
}
