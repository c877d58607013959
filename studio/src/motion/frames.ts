import { StudioFault } from '../api/fault'
import type { Joint, Skeleton } from './skeleton'

/** The bytes of frames, as docs/stream.md has them; all that knows the layout is here and in `FrameStore`. */
export const kMessageHeaderBytes = 16
/** Of a translation, in metres: one unit is 10 µm. */
export const kTranslationUnit = 1e-5
/** Of a rotation. */
export const kRotationUnit = 1 / 32767
const kLayout = 1

/** Frames that follow each other, in the layout of docs/stream.md. */
export interface FrameBlock {
  /** Number of the first frame, from 0. */
  readonly first: number
  readonly count: number
  /** `count` frames of `frameBytes` each, from `offset` on. */
  readonly buffer: ArrayBufferLike
  readonly offset: number
}

/** What frames are of: a stream's `header`, and what stands before the frames of a call. */
export interface FramesHeader {
  /** The recording whose skeleton it is, or the character's that plays it. */
  readonly recording: string
  /** The character whose joints these are, where one was asked for. */
  readonly character?: string
  readonly declarations: readonly { readonly name: string; readonly value: string }[]
  /** Frames a second. */
  readonly rate: number
  readonly layout: number
  readonly frame_bytes: number
  readonly joints: readonly Joint[]
  readonly translated: readonly number[]
  readonly tracks: readonly string[]
}

/** How many bytes a frame of this skeleton has. It is a multiple of 4. */
export function frameBytes(skeleton: Skeleton): number {
  return 12 * skeleton.translated.length + 4 * skeleton.tracks.length + 8 * skeleton.joints.length
}

/** The skeleton that a header tells of. Throws where its frames are laid out in a way that this page does not know. */
export function skeletonOf(header: FramesHeader): Skeleton {
  const joints = header.joints.map(({ name, parent, offset }) => ({ name, parent, offset }))
  const skeleton = { joints, translated: header.translated, tracks: header.tracks }
  if (header.layout !== kLayout || header.frame_bytes !== frameBytes(skeleton)) {
    throw new StudioFault('badAnswer', `layout ${header.layout}, ${header.frame_bytes} bytes a frame`)
  }
  return skeleton
}

/** What a header's declarations are, by name. */
export function declarationsOf(header: FramesHeader): Readonly<Record<string, string>> {
  return Object.fromEntries(header.declarations.map(({ name, value }) => [name, value]))
}

/** What the header of a binary message says; throws where the layout is not 1. */
export function messageHead(message: DataView): { first: number; count: number; leftOut: number } {
  if (message.getUint8(0) !== kLayout) throw new StudioFault('badAnswer', `frames of layout ${message.getUint8(0)}`)
  return { first: Number(message.getBigUint64(8, true)), count: message.getUint16(2, true), leftOut: message.getUint32(4, true) }
}

/** Reads a binary message of a stream. Throws where it is not of layout 1 or not as long as it says. */
export function decodeMessage(message: ArrayBuffer, bytesOfFrame: number): FrameBlock & { leftOut: number } {
  if (message.byteLength < kMessageHeaderBytes) throw new StudioFault('badAnswer', 'a message of frames that has no header')
  const head = messageHead(new DataView(message))
  if (message.byteLength !== kMessageHeaderBytes + head.count * bytesOfFrame) {
    throw new StudioFault('badAnswer', `${head.count} frames of ${bytesOfFrame} bytes in a message of ${message.byteLength}`)
  }
  return { ...head, buffer: message, offset: kMessageHeaderBytes }
}
