import type { Api } from '../api/client'
import { StudioFault } from '../api/fault'
import { withMotion } from '../api/types'
import { declarationsOf, skeletonOf } from '../motion/frames'
import { rigOf, type FrameTaker } from '../motion/frames_body'
import { FrameStore } from '../motion/frame_store'
import type { OpenedMotion } from '../motion/source'
import type { RenderRequest } from './request'

/** Loads the complete motion of a request. Rejects with the server's message if there is none. */
export async function gather(api: Api, { database, call, parameters, character }: RenderRequest, signal?: AbortSignal): Promise<OpenedMotion> {
  let motion: OpenedMotion | undefined
  const taker: FrameTaker = {
    begin(header) {
      const rig = rigOf(header)
      const store = new FrameStore(skeletonOf(header), header.rate, rig, header.frames)
      motion = { store, rig, character: header.character || undefined, originMs: header.origin_ms, declarations: declarationsOf(header) }
    },
    take(block) {
      motion!.store.put(block)
    },
  }
  const joints = character || undefined
  if (call === 'recording') {
    const { recording, from, to } = await spanOf(api, database, parameters)
    await api.motion(database, recording, from, to, joints, taker, signal)
  } else {
    await api.made(database, call, parameters, joints, taker, signal)
  }
  const { store } = motion!
  if (store.length === 0 || store.firstMissing(0) < store.length) throw new StudioFault('framesMissing', `${store.held} of ${store.length}`)
  return motion!
}

/** Returns the requested span of a recording, in ms of annotation time; all of it by default. */
async function spanOf(api: Api, database: string, parameters: RenderRequest['parameters']): Promise<{ recording: string; from: number; to: number }> {
  const { recording, from, to } = parameters as { recording: string; from?: number; to?: number }
  if (typeof from === 'number' && typeof to === 'number') return { recording, from, to }
  const info = withMotion(await api.recording(database, recording))
  const end = info.clock_origin_ms + Math.ceil((1000 * info.frames) / info.frames_per_second)
  return { recording, from: from ?? info.clock_origin_ms, to: to ?? end }
}
