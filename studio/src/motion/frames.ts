import { StudioFault } from '../api/fault'
import type { Joint, Skeleton } from './skeleton'

/** The bytes of frames as specified in docs/stream.md; only this file and `FrameStore` know the layout. */
export const kMessageHeaderBytes = 16
/** For a translation, in metres: one unit is 10 µm. */
export const kTranslationUnit = 1e-5
/** For a rotation. */
export const kRotationUnit = 1 / 32767
const kLayout = 1

/** Consecutive frames, in the layout of docs/stream.md. */
export interface FrameBlock {
  /** Number of the first frame, from 0. */
  readonly first: number
  readonly count: number
  /** `count` frames of `frameBytes` each, from `offset` on. */
  readonly buffer: ArrayBufferLike
  readonly offset: number
}

/** Describes frames: a stream's `header`, and the header before the frames of a call. */
export interface FramesHeader {
  /** The recording whose skeleton is used, or whose motion is retargeted to the character. */
  readonly recording: string
  /** The character whose joints are used, if one was requested. */
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

/** Returns the number of bytes of a frame of this skeleton, a multiple of 4. */
export function frameBytes(skeleton: Skeleton): number {
  return 12 * skeleton.translated.length + 4 * skeleton.tracks.length + 8 * skeleton.joints.length
}

/** Returns the skeleton described by a header. Throws if the frame layout is not supported by this page. */
export function skeletonOf(header: FramesHeader): Skeleton {
  const joints = header.joints.map(({ name, parent, offset }) => ({ name, parent, offset }))
  const skeleton = { joints, translated: header.translated, tracks: header.tracks }
  if (header.layout !== kLayout || header.frame_bytes !== frameBytes(skeleton)) {
    throw new StudioFault('badAnswer', `layout ${header.layout}, ${header.frame_bytes} bytes a frame`)
  }
  return skeleton
}

/** Returns a header's declarations, by name. */
export function declarationsOf(header: FramesHeader): Readonly<Record<string, string>> {
  return Object.fromEntries(header.declarations.map(({ name, value }) => [name, value]))
}

/** Reads the header of a binary message; throws if the layout is not 1. */
export function messageHead(message: DataView): { first: number; count: number; leftOut: number } {
  if (message.getUint8(0) !== kLayout) throw new StudioFault('badAnswer', `frames of layout ${message.getUint8(0)}`)
  return { first: Number(message.getBigUint64(8, true)), count: message.getUint16(2, true), leftOut: message.getUint32(4, true) }
}

/** Reads a binary message of a stream. Throws if it is not of layout 1 or its length does not match its header. */
export function decodeMessage(message: ArrayBuffer, bytesOfFrame: number): FrameBlock & { leftOut: number } {
  if (message.byteLength < kMessageHeaderBytes) throw new StudioFault('badAnswer', 'a message of frames without a header')
  const head = messageHead(new DataView(message))
  if (message.byteLength !== kMessageHeaderBytes + head.count * bytesOfFrame) {
    throw new StudioFault('badAnswer', `${head.count} frames of ${bytesOfFrame} bytes in a message of ${message.byteLength}`)
  }
  return { ...head, buffer: message, offset: kMessageHeaderBytes }
}
