import { StudioFault } from '../api/fault'
import type { RigPart, Synthesis } from '../api/schema'
import { kMessageHeaderBytes, messageHead, type FrameBlock, type FramesHeader } from './frames'
import type { Rig } from './skeleton'

/** The JSON text before the frames in the answer of a call (`application/vnd.signweave.frames`). */
export interface MotionHeader extends FramesHeader {
  /** The number of frames that follow. */
  readonly frames: number
  /** Annotation time of frame 0, ms. */
  readonly origin_ms: number
  /** Maps parts to joints; missing if the rig map could not be determined. */
  readonly rig?: { readonly parts: Readonly<Record<string, RigPart>>; readonly sides_swapped?: boolean }
  /** For generated motion; for a piece of a file to be imported, which piece it is. */
  readonly report?: Synthesis & { readonly piece?: { /** Of the file. */ readonly frames_per_second: number } }
}

/** Receives the header, then the frames as they arrive; their bytes are valid only until the call returns. */
export interface FrameTaker {
  begin(header: MotionHeader): void
  take(block: FrameBlock): void
}

/** Maps parts to joints; empty if the rig map could not be determined. */
export function rigOf({ rig }: Pick<MotionHeader, 'rig'>): Rig {
  return Object.fromEntries(Object.entries(rig?.parts ?? {}).map(([part, { index, offset }]) => [part, { joint: index, offset: vectorOf(offset) }]))
}
function vectorOf(offset: readonly number[] | undefined): readonly [number, number, number] | undefined {
  if (!offset) return undefined
  const [x, y, z] = offset
  if (offset.length !== 3) throw new StudioFault('badAnswer', `an offset of ${offset.length} numbers`)
  return [x, y, z]
}

const kLongestText = 64 << 20

/** Reads the answer of a call as it arrives, until its end. Throws if the bytes do not match docs/http.md or end too early. */
export async function readFrames(body: ReadableStream<Uint8Array>, taker: FrameTaker): Promise<void> {
  const bytes = new Bytes(body.getReader())
  const length = view(await bytes.take(4)).getUint32(0, true)
  if (length > kLongestText) throw new StudioFault('badAnswer', `${length} bytes of header`)
  const header = parsed(await bytes.take(length))
  taker.begin(header)
  for (let come = 0; come < header.frames;) {
    const head = messageHead(view(await bytes.take(kMessageHeaderBytes)))
    const frames = await bytes.take(head.count * header.frame_bytes)
    taker.take({ ...head, buffer: frames.buffer, offset: frames.byteOffset })
    come += head.count
    if (head.count === 0) throw new StudioFault('badAnswer', 'a message without frames')
  }
  await bytes.end()
}

function parsed(text: Uint8Array): MotionHeader {
  try {
    return JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(text)) as MotionHeader
  } catch {
    throw new StudioFault('badAnswer', 'the header of the frames is not JSON')
  }
}

const view = (bytes: Uint8Array): DataView => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength)

/** Regroups bytes that arrive in chunks of any length. */
class Bytes {
  private rest = new Uint8Array(0)

  constructor(private readonly reader: ReadableStreamDefaultReader<Uint8Array>) {}

  /** Returns the next `count` bytes. Throws if the answer ends before. */
  async take(count: number): Promise<Uint8Array> {
    if (this.rest.length < count) {
      const parts = [this.rest]
      for (let have = this.rest.length; have < count;) {
        const { value, done } = await this.next()
        if (done) throw new StudioFault('badAnswer', `it ends ${count - have} bytes too early`)
        parts.push(value as Uint8Array<ArrayBuffer>)
        have += value.length
      }
      this.rest = joined(parts)
    }
    const taken = this.rest.subarray(0, count)
    this.rest = this.rest.subarray(count)
    return taken
  }

  /** Throws if more bytes arrive. */
  async end(): Promise<void> {
    if (this.rest.length > 0 || !(await this.next()).done) throw new StudioFault('badAnswer', 'it is longer than its header says')
  }

  private next(): Promise<ReadableStreamReadResult<Uint8Array>> {
    return this.reader.read().catch((fault: unknown) => {
      throw fault instanceof TypeError ? new StudioFault('unreachable') : fault // how a page is notified of a broken connection
    })
  }
}

function joined(parts: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0))
  let at = 0
  for (const part of parts) {
    all.set(part, at)
    at += part.length
  }
  return all
}
