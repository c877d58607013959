/// Fetches and unpacks pieces of motion beside the main thread: parsing JSON would hold up the picture.
import { encodeJson, skeletonOfJson, type MotionAnswer } from './frames'
import type { ReportSign } from '../api/client'
import type { Skeleton } from './skeleton'

/** What is asked for: `first` is the number that the first frame of the answer gets. */
export interface PieceRequest {
  readonly id: number
  readonly url: string
  readonly init?: { method: string; headers: Record<string, string>; body?: string }
  readonly first: number
}

export type PieceAnswer =
  | { readonly id: number; readonly skeleton: Skeleton; readonly rate: number; readonly declarations: Record<string, string>; readonly signs?: readonly ReportSign[];
      readonly first: number; readonly count: number; readonly buffer: ArrayBuffer }
  /** Refused: what the server answered, and its status; 0 where it did not answer, −1 where the answer is no motion. */
  | { readonly id: number; readonly refused: string; readonly status: number }

self.onmessage = async ({ data }: MessageEvent<PieceRequest>) => {
  const answer = (message: PieceAnswer, moved: Transferable[] = []) => self.postMessage(message, { transfer: moved })
  const { id } = data
  let response: Response
  try {
    response = await fetch(data.url, data.init)
    if (!response.ok) return answer({ id, refused: await response.text(), status: response.status })
  } catch {
    return answer({ id, refused: '', status: 0 })
  }
  try {
    const whole = (await response.json()) as MotionAnswer
    const json = 'motion' in whole ? whole.motion : whole
    const signs = 'motion' in whole ? (whole.signs as readonly ReportSign[] | undefined) : undefined
    const skeleton = skeletonOfJson(json)
    const { first, count, buffer } = encodeJson(json, skeleton, data.first)
    answer({ id, skeleton, rate: json.frames_per_second, declarations: whole.declarations ?? {}, signs, first, count, buffer }, [buffer])
  } catch (fault) {
    answer({ id, refused: fault instanceof Error ? fault.message : String(fault), status: -1 })
  }
}
