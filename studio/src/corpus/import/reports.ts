import type { Imported, Inspected } from '../../api/corpus_answers'
import { ApiError } from '../../api/fault'
import { keyOf } from './pairs'
import { isGone } from './sender.svelte'

const kPassingCodes = new Set(['busy', 'cancelled', 'conflict', 'io', 'no_memory', 'stopping'])
const kPassing = new Set([401, 403, 409, 429])

/** Whether a call was refused for what was asked. Else the server was away, busy or being stopped, and the same call may do another time. */
export function isOfTheCall(fault: unknown): boolean {
  // A job that failed has the status 500, and its code.
  return fault instanceof ApiError && fault.status <= 500 && !kPassing.has(fault.status) && !kPassingCodes.has(fault.code) && !isGone(fault)
}

export const isCancelled = (fault: unknown) => fault instanceof ApiError && fault.code === 'cancelled'
/** What became of a recording whose call was refused. */
export const failedBy = (fault: unknown, name: string): Imported => ({ name, outcome: 'failed', error: fault instanceof Error ? fault.message : String(fault) })

/** Reports, and by recording what the server says of its corrections where it cannot read it with them. */
export interface Taken {
  readonly reports: readonly Inspected[]
  readonly errors: ReadonlyMap<string, string>
}
/** Reports that take the place of those before. One that could be read, and cannot as it is corrected, stays as it was: the correction can be mended. */
export function withGood(told: readonly Inspected[], before: readonly Inspected[], isCorrected: (key: string) => boolean): Taken {
  const earlier = new Map(before.map((one) => [keyOf(one.files), one])),
    errors = new Map<string, string>()
  const reports = told.map((one) => {
    const key = keyOf(one.files),
      good = earlier.get(key)
    if (!one.error || !good) return one
    if (!good.error && isCorrected(key) && JSON.stringify(good.files) === JSON.stringify(one.files)) {
      errors.set(key, one.error)
      return { ...good, known: one.known }
    }
    // Its body is that of the same motion, whatever else belongs to it now.
    return one.files.motion ? { ...one, rig: good.rig, joints: good.joints } : one
  })
  return { reports, errors }
}
