import type { Stand } from './checked_tiers'
import { faultsOf, type Frames, type Review } from './review'

/** A review that is neither stored nor given up, and of what. */
export interface Draft {
  readonly frames: Frames
  readonly review: Review
  /** The checked phases that were stored when it was begun. */ readonly stand?: Stand
}

const keyOf = (database: string, recording: string) => `signweave.review.${encodeURIComponent(database)}/${encodeURIComponent(recording)}`
const kVersion = 1

/** What a window knows of the draft that is kept: the revision that it wrote or read last; none where there was none. */
export type Revision = string | undefined

export const isKeyOf = (key: string | null, database: string, recording: string) => key === null || key === keyOf(database, recording)

/**
 * Keeps a review in this browser, as a revision that it gives; `changed` where another window has kept or dropped something since `seen`, which then
 * stays as it is; `full` where nothing can be kept.
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
/** What was kept; none where there is nothing that can be used. */
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
/** Drops what was kept, unless another window has kept something since. */
export function dropDraft(database: string, recording: string, seen: Revision, storage: Storage = localStorage): void {
  try {
    if (revisionOf(database, recording, storage) === seen) storage.removeItem(keyOf(database, recording))
  } catch {
    // nothing may be kept, so nothing is
  }
}
/** Of a text that is stored; a broken one has none, like one that is not there. */
function revisionIn(text: string | null): Revision {
  try {
    const { revision, version } = JSON.parse(text ?? '{}') as { revision?: unknown; version?: unknown }
    return typeof revision === 'string' ? revision : version === kVersion ? 'first' : undefined
  } catch {
    return undefined
  }
}
/** Whether a draft is of this motion as it is now. */
export const isOf = (draft: Draft, frames: Frames) =>
  draft.frames.count === frames.count && draft.frames.rate === frames.rate && draft.frames.originMs === frames.originMs
