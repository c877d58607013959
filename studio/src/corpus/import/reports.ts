import type { ImportedReply, InspectedRecording } from '../../api/schema'
import { ApiError } from '../../api/fault'
import { keyOf } from './pairs'
import { isGone } from './sender.svelte'

const kPassingCodes = new Set(['busy', 'cancelled', 'conflict', 'io', 'no_memory', 'stopping'])
const kPassing = new Set([401, 403, 409, 429])

/** Whether a call was refused because of its content. Otherwise the server was unreachable, busy or stopping, and the same call may succeed later. */
export function isOfTheCall(fault: unknown): boolean {
  // A failed job has the status 500, and its code.
  return fault instanceof ApiError && fault.status <= 500 && !kPassing.has(fault.status) && !kPassingCodes.has(fault.code) && !isGone(fault)
}

export const isCancelled = (fault: unknown) => fault instanceof ApiError && fault.code === 'cancelled'
/** Returns the outcome of a recording whose call was refused. */
export const failedBy = (fault: unknown, name: string): ImportedReply => ({
  name,
  outcome: 'failed',
  error: fault instanceof Error ? fault.message : String(fault),
  declarations: {},
})

/** Reports, and the server's faults by recording, for those it cannot read with their corrections. */
export interface Taken {
  readonly reports: readonly InspectedRecording[]
  readonly errors: ReadonlyMap<string, string>
}
/**
 * Returns the reports that replace the previous ones. A recording that was readable but fails with its corrections keeps its report, so that the correction can
 * be fixed.
 */
export function withGood(fresh: readonly InspectedRecording[], before: readonly InspectedRecording[], isCorrected: (key: string) => boolean): Taken {
  const earlier = new Map(before.map((one) => [keyOf(one.files), one])),
    errors = new Map<string, string>()
  const reports = fresh.map((one) => {
    const key = keyOf(one.files),
      good = earlier.get(key)
    if (!one.error || !good) return one
    if (!good.error && isCorrected(key) && JSON.stringify(good.files) === JSON.stringify(one.files)) {
      errors.set(key, one.error)
      return { ...good, known: one.known, plan: one.plan }
    }
    // Its body is that of the same motion, whatever else belongs to it now.
    return one.files.motion ? { ...one, rig: good.rig, joints: good.joints } : one
  })
  return { reports, errors }
}
