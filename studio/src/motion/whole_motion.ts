import { StudioFault } from '../api/fault'
import { declarationsOf, skeletonOf } from './frames'
import { rigOf, type FrameTaker } from './frames_body'
import { FrameStore } from './frame_store'
import type { OpenedMotion } from './source'

/** Resolves with the motion that a call answers when all its frames have arrived. */
export async function wholeMotion(call: (taker: FrameTaker) => Promise<void>): Promise<OpenedMotion> {
  let opened: OpenedMotion | undefined
  await call({
    begin: (header) => {
      const rig = rigOf(header)
      opened = {
        store: new FrameStore(skeletonOf(header), header.rate, rig, header.frames),
        rig,
        swapped: header.rig?.sides_swapped,
        fileRate: header.report?.piece?.frames_per_second,
        character: header.character,
        originMs: header.origin_ms,
        declarations: declarationsOf(header),
      }
    },
    take: (block) => opened!.store.put(block),
  })
  if (!opened) throw new StudioFault('framesMissing')
  return opened
}
