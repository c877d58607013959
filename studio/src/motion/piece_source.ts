import type { Api, PieceWishes } from '../api/client'
import { StudioFault } from '../api/fault'
import { declarationsOf, skeletonOf } from './frames'
import { rigOf } from './frames_body'
import { FrameStore } from './frame_store'
import type { MotionSource, OpenedMotion } from './source'

/** A short piece of a recording, fetched at once; its frame 0 is the first of the piece. */
export class PieceSource implements MotionSource {
  readonly grows = false
  complete = false
  onProgress?: (complete: boolean) => void
  onFault?: (fault: Error) => void
  private readonly abort = new AbortController()

  /** `title` stands on the screen. */
  constructor(
    private readonly api: Api,
    private readonly database: string,
    private readonly recording: string,
    private readonly wishes: PieceWishes,
    readonly title = recording,
  ) {}

  async open(): Promise<OpenedMotion> {
    let opened: OpenedMotion | undefined
    await this.api.piece(
      this.database,
      this.recording,
      this.wishes,
      {
        begin: (header) => {
          const rig = rigOf(header)
          opened = {
            store: new FrameStore(skeletonOf(header), header.rate, rig, header.frames),
            rig,
            character: header.character,
            originMs: header.origin_ms,
            declarations: declarationsOf(header),
          }
        },
        take: (block) => opened!.store.put(block),
      },
      this.abort.signal,
    )
    if (!opened) throw new StudioFault('framesMissing')
    this.complete = true
    return opened
  }

  close(): void {
    this.abort.abort()
  }
}
