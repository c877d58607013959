import type { Api } from '../api/client'
import { errorOf, StudioFault } from '../api/fault'
import type { FaultText } from '../api/schema'
import { withMotion } from '../api/types'
import { FrameStore } from './frame_store'
import { declarationsOf, decodeMessage, skeletonOf, type FrameBlock, type FramesHeader } from './frames'
import { rigOf } from './frames_body'
import type { MotionSource, OpenedMotion } from './source'
import type { Rig } from './skeleton'

/** Seconds of a live stream that are stored. */
const kKept = 600

/** An utterance signed live over the WebSocket of docs/stream.md: in real time, followed by a living rest. */
export class StreamSource implements MotionSource {
  readonly grows = true
  readonly complete = false
  onProgress?: (complete: boolean) => void
  onFault?: (fault: Error) => void
  /** Called with the gloss whose stroke begins at a frame; without a gloss if the signer returns to rest. */
  onPlace?: (frame: number, gloss?: string) => void
  /** Something was refused or skipped, and the stream continues. */
  onNotice?: (fault: Error) => void
  /** Frames that the server skipped because this page was slow. */
  leftOut = 0
  private socket?: WebSocket
  private header?: FramesHeader
  private store?: FrameStore
  /** Frames that arrived while the rig was still being fetched. */
  private waiting: FrameBlock[] = []
  private over = false
  private appended = 0

  /** Appended utterances that are not answered yet, by the id with which they were sent. */
  private readonly asked = new Map<string, { resolve: () => void; reject: (fault: Error) => void }>()

  /**
   * `title` is signed first; with `resting`, a recording, nothing is, and its signer rests until something is. `how` holds the other parameters of `open`:
   * `transition`, `duration`, `tempo`, `align`, `rate`.
   */
  constructor(
    private readonly api: Api,
    private readonly database: string,
    readonly title: string,
    private readonly character?: string,
    private readonly resting?: string,
    private readonly how: object = {},
  ) {}

  open(): Promise<OpenedMotion> {
    return new Promise((resolve, reject) => {
      const socket = (this.socket = new WebSocket(this.api.streamUrl(this.database)))
      socket.binaryType = 'arraybuffer'
      const fail = (fault: Error) => {
        this.close()
        if (this.store) this.onFault?.(fault)
        else reject(fault)
      }
      socket.onopen = () => {
        this.send({ ...this.how, type: 'open', pace: 'live', idle: 'rest', batch: 2, character: this.character, recording: this.resting })
        if (this.resting === undefined) this.sign(this.title)
      }
      // A failed socket gives the page no reason, and closes.
      socket.onclose = ({ reason, code }) => {
        if (!this.over) fail(this.header ? new StudioFault('streamClosed', reason || String(code)) : new StudioFault('streamRefused', reason))
      }
      socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
        if (this.over) return
        try {
          if (typeof data === 'string') this.handle(JSON.parse(data), fail)
          else if (this.header) this.take(decodeMessage(data, this.header.frame_bytes), this.header, resolve, fail)
        } catch (fault) {
          fail(fault as Error)
        }
      }
    })
  }

  /** Replaces the rest of the queue by another utterance, with a transition from the current pose. */
  sign(utterance: string): void {
    this.send({ type: 'sign', utterance })
  }

  /** Appends an utterance to the queue. Resolves when the server accepts it, rejects with its message if it does not. */
  append(utterance: string): Promise<void> {
    return new Promise((resolve, reject) => {
      if (this.socket?.readyState !== WebSocket.OPEN) return reject(new StudioFault('streamClosed'))
      const id = `append ${++this.appended}`
      this.asked.set(id, { resolve, reject })
      this.send({ type: 'append', utterance, id })
    })
  }

  close(): void {
    for (const { reject } of this.asked.values()) reject(new StudioFault('streamClosed'))
    this.asked.clear()
    this.over = true
    this.socket?.close(1000)
  }

  private take(block: FrameBlock & { leftOut: number }, header: FramesHeader, resolve: (opened: OpenedMotion) => void, fail: (fault: Error) => void): void {
    this.leftOut = block.leftOut
    if (!this.store) {
      if (this.waiting.push(block) === 1) this.begin(header, resolve).catch(fail)
      return
    }
    this.store.put(block)
    this.store.forgetBefore(this.store.length - Math.round(kKept * header.rate))
    this.onProgress?.(false)
  }

  private async begin(header: FramesHeader, resolve: (opened: OpenedMotion) => void): Promise<void> {
    const rig = await this.rig(header.recording)
    const store = new FrameStore(skeletonOf(header), header.rate, rig)
    for (const block of this.waiting) store.put(block)
    this.waiting = []
    this.store = store
    resolve({ store, rig, character: header.character, originMs: 0, declarations: declarationsOf(header) })
  }

  /** A stream does not contain the rig map; a frame of the recording does, in the same joints. */
  private async rig(recording: string): Promise<Rig> {
    const { clock_origin_ms: from } = withMotion(await this.api.recording(this.database, recording))
    let rig: Rig = {}
    await this.api.motion(this.database, recording, from, from + 20, this.character, { begin: (header) => (rig = rigOf(header)), take: () => {} })
    return rig
  }

  private handle(message: { type: string; frame?: number } & Record<string, unknown>, fail: (fault: Error) => void): void {
    const { type, frame = 0 } = message
    const asked = this.asked.get(String(message.id))
    if (asked) {
      this.asked.delete(String(message.id))
      return type === 'error' ? asked.reject(errorOf(message as unknown as FaultText, 0)) : asked.resolve()
    }
    if (type === 'header') {
      this.header = message as unknown as FramesHeader
    } else if (type === 'error') {
      const fault = errorOf(message as unknown as FaultText, 0)
      // Before the first frame the fault is final; later the stream continues.
      if (this.header) this.onNotice?.(fault)
      else fail(fault)
    } else if (type === 'place') this.onPlace?.(frame, String(message.gloss))
    else if (type === 'rest') this.onPlace?.(frame)
  }

  private send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message))
  }
}
