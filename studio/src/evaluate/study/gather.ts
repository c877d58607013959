import { readEaf } from '../../annotation/eaf'
import type { Recording } from '../../api/schema'
import type { Api } from '../../api/client'
import { ApiError } from '../../api/fault'
import { hasMotion } from '../../api/types'
import { gapsOf, shownOf, usable, type Gap } from './gaps'
import { Random } from './random'
import type { Source } from './study'

/** The maximum number of recordings examined: out of more, this many are chosen at random. */
export const kMostRecordings = 200

/** Returns the recordings of a database from which a study with this seed takes its gaps. */
export function sampled(recordings: readonly string[], seed: number): readonly string[] {
  return recordings.length <= kMostRecordings ? recordings : new Random(seed, 'recordings').shuffled(recordings).slice(0, kMostRecordings).toSorted()
}

/** The usable gaps, and the recordings whose annotation cannot be read. */
export interface Gathered {
  readonly sources: readonly Source[]
  readonly leftOut: readonly string[]
}

/** Returns the usable gaps of some recordings; `onprogress` is called with the number of recordings read so far. Recordings without annotation have none. */
export async function gatherSources(
  api: Api,
  database: string,
  recordings: readonly string[],
  around: number,
  onprogress: (done: number) => void,
  signal: AbortSignal,
): Promise<Gathered> {
  const sources: Source[] = [],
    leftOut: string[] = []
  for (const [done, recording] of recordings.entries()) {
    if (signal.aborted) throw signal.reason
    onprogress(done)
    let info: Recording, eaf: string
    try {
      ;[info, eaf] = await Promise.all([api.recording(database, recording), api.annotation(database, recording)])
    } catch (fault) {
      if (!(fault instanceof ApiError) || ![400, 404, 422, 500].includes(fault.status)) throw fault // the fault is not specific to this recording
      if (fault.status !== 404) leftOut.push(recording)
      continue
    }
    const gaps = gapsIn(eaf)
    if (!gaps) leftOut.push(recording)
    if (!hasMotion(info)) continue
    const ms = 1000 / info.frames_per_second,
      at = (frame: number) => info.clock_origin_ms + frame * ms
    const captured = { begin: at(0), end: at(info.frames - 1) }
    const broken = (info.defects ?? []).flatMap(({ first_frame, end_frame }) =>
      first_frame === undefined || end_frame === undefined ? [] : [{ begin: at(first_frame), end: at(end_frame) }],
    )
    for (const gap of usable(gaps ?? [], captured, broken)) sources.push({ recording, ...gap, ...shownOf(gap, captured, around) })
  }
  return { sources, leftOut }
}
function gapsIn(eaf: string): readonly Gap[] | undefined {
  try {
    return gapsOf(readEaf(eaf))
  } catch {
    return undefined
  }
}
