import type { Candidate, FoundSegment } from '../api/schema'
import type { Api } from '../api/client'
import { ApiError } from '../api/fault'
import { withMotion } from '../api/types'
import { kEmpty, piecePlace, signPlace, type Place, type Project } from './project'
import { canBeTyped, quoted } from './utterance'

/** If two signs are separated by at least this much rest, the server keeps no recorded transition; a full stop is put between them. */
const kRestMs = 1000
/** The number of glosses per request. */
const kAtOnce = 60

/** Returns the signs of a recording as edits count them: of several sign tiers the one with the most signs, on equal numbers the first by name. */
export function mainSigns(signs: readonly FoundSegment[]): readonly FoundSegment[] {
  const tiers = new Map<string, FoundSegment[]>()
  for (const sign of signs) {
    if (!tiers.has(sign.tier)) tiers.set(sign.tier, [])
    tiers.get(sign.tier)!.push(sign)
  }
  const names = [...tiers.keys()].sort((a, b) => tiers.get(b)!.length - tiers.get(a)!.length || (a < b ? -1 : 1))
  return names.length > 0 ? tiers.get(names[0])!.toSorted((a, b) => a.begin_ms - b.begin_ms) : []
}

/** Converts a recording's signs to the places of a project, each with its own token; a sign that is no token of its gloss becomes a piece. */
export async function projectFrom(api: Api, database: string, recording: string, signal?: AbortSignal): Promise<Project> {
  const [stored, answers] = await Promise.all([api.recording(database, recording), api.signs(database, recording)])
  const info = withMotion(stored)
  const signs = mainSigns(answers)
  signal?.throwIfAborted()
  const glosses = [...new Set(signs.map(({ name }) => name))].filter(canBeTyped)
  const tokens = new Map<string, readonly Candidate[]>()
  for (let at = 0; at < glosses.length; at += kAtOnce) {
    for (const [gloss, rows] of await candidates(api, database, glosses.slice(at, at + kAtOnce), signal)) tokens.set(gloss, rows)
  }
  const frameAt = (ms: number) => ((ms - info.clock_origin_ms) * info.frames_per_second) / 1000
  const places = signs.map((sign, k): Place => {
    const rests = k > 0 && sign.begin_ms - signs[k - 1].end_ms >= kRestMs
    return { ...placeOf(sign, tokens.get(sign.name) ?? [], frameAt), pause: rests ? 'stop' : 'none' }
  })
  return { ...kEmpty, original: recording, places }
}

/** Returns the place of a sign: the token whose frames contain its middle. */
export function placeOf({ name, recording, begin_ms, end_ms }: FoundSegment, rows: readonly Candidate[], frameAt: (ms: number) => number): Place {
  const middle = frameAt((begin_ms + end_ms) / 2)
  const own = rows.find((row) => row.recording === recording && row.frames.begin <= middle && middle < row.frames.end)
  return own ? signPlace(name, own.token) : piecePlace(recording, Math.max(0, begin_ms), end_ms)
}

/** Returns the tokens of the given glosses. A gloss that cannot be signed fails the whole call, so the others are requested again without it. */
async function candidates(api: Api, database: string, glosses: readonly string[], signal?: AbortSignal): Promise<[string, readonly Candidate[]][]> {
  if (glosses.length === 0) return []
  try {
    const { places } = await api.explained(database, { utterance: glosses.map(quoted).join(' ') }, signal)
    return glosses.map((gloss, k) => [gloss, places[k].candidates])
  } catch (fault) {
    if (!(fault instanceof ApiError) || fault.status !== 404) throw fault
    if (glosses.length === 1) return []
    const half = glosses.length >> 1
    return [...(await candidates(api, database, glosses.slice(0, half), signal)), ...(await candidates(api, database, glosses.slice(half), signal))]
  }
}
