import { faultsOf, type Frames, type Review } from './review'

/** A review that is neither stored nor given up, and of what. */
export interface Draft { readonly frames: Frames; readonly review: Review }

const keyOf = (database: string, recording: string) => `signweave.review.${encodeURIComponent(database)}/${encodeURIComponent(recording)}`
const kVersion = 1

/** Keeps a review in this browser. False where it cannot: there is no room, or nothing may be kept. */
export function keepDraft(database: string, recording: string, draft: Draft, storage: Storage = localStorage): boolean {
  try {
    storage.setItem(keyOf(database, recording), JSON.stringify({ version: kVersion, ...draft }))
    return true
  } catch {
    return false
  }
}
/** What was kept; none where there is nothing that can be used. */
export function keptDraft(database: string, recording: string, storage: Storage = localStorage): Draft | undefined {
  try {
    const { version, frames, review } = JSON.parse(storage.getItem(keyOf(database, recording)) ?? 'null') as Draft & { version: number }
    return version === kVersion && faultsOf(review).length === 0 ? { frames, review } : undefined
  } catch {
    return undefined
  }
}
export function dropDraft(database: string, recording: string, storage: Storage = localStorage): void {
  try {
    storage.removeItem(keyOf(database, recording))
  } catch {
    // nothing may be kept, so nothing is
  }
}
/** Whether a draft is of this motion as it is now. */
export const isOf = (draft: Draft, frames: Frames) => draft.frames.count === frames.count && draft.frames.rate === frames.rate
  && draft.frames.originMs === frames.originMs
