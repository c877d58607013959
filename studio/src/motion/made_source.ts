import { rigOf, type Api, type RecordingInfo } from '../api/client'
import { FrameStore } from './frame_store'
import { Pieces } from './pieces'
import type { MotionSource, OpenedMotion } from './source'

/** Signing that a call makes whole (`edit`): fetched once, unpacked beside the main thread. */
export class MadeSource implements MotionSource {
  readonly grows = false
  complete = false
  private readonly pieces = new Pieces()

  /** `info` is of the recording whose skeleton the motion has: the edited one. */
  constructor(private readonly api: Api, readonly title: string, private readonly url: string, private readonly body: object,
              private readonly info: Promise<RecordingInfo>) {}

  async open(): Promise<OpenedMotion> {
    const [info, piece] = await Promise.all([
      this.info,
      this.pieces.fetch(this.url, 0, {
        method: 'POST', headers: this.api.headers({ 'Content-Type': 'application/json' }), body: JSON.stringify({ ...this.body, format: 'json' }),
      }),
    ])
    const rig = rigOf(info)
    const store = new FrameStore(piece.skeleton, piece.rate, rig)
    store.put({ ...piece, offset: 0 })
    this.complete = true
    this.pieces.close()
    return { store, rig, originMs: 0, declarations: piece.declarations, signs: piece.signs, recording: info.recording }
  }

  close(): void {
    this.pieces.close()
  }
}
