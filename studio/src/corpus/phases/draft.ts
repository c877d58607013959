import type { Stand } from './checked_tiers'
import { faultsOf, type Frames, type Review } from './review'

/** A review that is neither stored nor discarded, and the motion to which it belongs. */
export interface Draft {
  readonly frames: Frames
  readonly review: Review
  /** The checked phases that were stored when the review began. */ readonly stand?: Stand
}

const keyOf = (database: string, recording: string) => `signweave.review.${encodeURIComponent(database)}/${encodeURIComponent(recording)}`
const kVersion = 1

/** The revision of the draft that a window wrote or read last; undefined if there was none. */
export type Revision = string | undefined

export const isKeyOf = (key: string | null, database: string, recording: string) => key === null || key === keyOf(database, recording)

/**
 * Stores a review in this browser and returns its revision; returns `changed` if another window has stored or dropped something since `seen`, which is then
 * left as it is; `full` if nothing can be stored.
 */
export function keepDraft(
  database: string,
  recording: string,
  draft: Draft,
  seen: Revision,
  storage: Storage = localStorage,
): { readonly revision: string } | 'changed' | 'full' {
  try {
    const key = keyOf(database, recording)
    if (revisionIn(storage.getItem(key)) !== seen) return 'changed'
    const revision = Math.random().toString(36).slice(2)
    storage.setItem(key, JSON.stringify({ version: kVersion, revision, ...draft }))
    return { revision }
  } catch {
    return 'full'
  }
}
/** Returns the stored draft; undefined if there is no usable one. */
export function keptDraft(database: string, recording: string, storage: Storage = localStorage): Draft | undefined {
  try {
    const { version, frames, review, stand } = JSON.parse(storage.getItem(keyOf(database, recording)) ?? 'null') as Draft & { version: number }
    return version === kVersion && faultsOf(review).length === 0 ? { frames, review, ...(stand ? { stand } : {}) } : undefined
  } catch {
    return undefined
  }
}
export function revisionOf(database: string, recording: string, storage: Storage = localStorage): Revision {
  try {
    return revisionIn(storage.getItem(keyOf(database, recording)))
  } catch {
    return undefined
  }
}
/** Drops the draft, unless another window has stored one since. */
export function dropDraft(database: string, recording: string, seen: Revision, storage: Storage = localStorage): void {
  try {
    if (revisionOf(database, recording, storage) === seen) storage.removeItem(keyOf(database, recording))
  } catch {
    // storage may be forbidden, in which case nothing is stored
  }
}
/** Returns the revision of a stored text; a broken text has none, like a missing one. */
function revisionIn(text: string | null): Revision {
  try {
    const { revision, version } = JSON.parse(text ?? '{}') as { revision?: unknown; version?: unknown }
    return typeof revision === 'string' ? revision : version === kVersion ? 'first' : undefined
  } catch {
    return undefined
  }
}
/** Whether a draft belongs to this motion in its current state. */
export const isOf = (draft: Draft, frames: Frames) =>
  draft.frames.count === frames.count && draft.frames.rate === frames.rate && draft.frames.originMs === frames.originMs
