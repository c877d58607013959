import type { Api } from '../api/client'
import { StudioFault } from '../api/fault'
import { declarationsOf, skeletonOf } from './frames'
import { rigOf } from './frames_body'
import { FrameStore } from './frame_store'
import type { MotionSource, OpenedMotion } from './source'

/** Signing that a call makes whole (`sign`, `edit`); its frames are shown as they come. */
export class MadeSource implements MotionSource {
  readonly grows = false
  complete = false
  onProgress?: (complete: boolean) => void
  onFault?: (fault: Error) => void
  private readonly abort = new AbortController()

  /** `body` are the call's parameters; `character` names the one whose joints the poses are for. */
  constructor(
    private readonly api: Api,
    private readonly database: string,
    readonly title: string,
    private readonly call: 'sign' | 'edit',
    private readonly body: object,
    private readonly character?: string,
  ) {}

  open(): Promise<OpenedMotion> {
    return new Promise((resolve, reject) => {
      let opened: OpenedMotion | undefined
      let shown = false
      const { signal } = this.abort
      this.api
        .made(
          this.database,
          this.call,
          this.body,
          this.character,
          {
            begin: (header) => {
              const rig = rigOf(header)
              const store = new FrameStore(skeletonOf(header), header.rate, rig, header.frames)
              const { character, report } = header
              opened = { store, rig, character, originMs: header.origin_ms, declarations: declarationsOf(header), signs: report?.signs, report }
            },
            take: (block) => {
              opened!.store.put(block)
              if (shown) return this.onProgress?.(false)
              shown = true
              resolve(opened!)
            },
          },
          signal,
        )
        .then(() => {
          if (!shown) throw new StudioFault('framesMissing')
          this.complete = true
          this.onProgress?.(true)
        })
        .catch((fault: unknown) => {
          if (!shown) reject(fault)
          else if (!signal.aborted) this.onFault?.(fault as Error)
        })
    })
  }

  close(): void {
    this.abort.abort()
  }
}
