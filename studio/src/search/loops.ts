/** How many loops go beside each other: all begin at once and wait for the longest, each by itself, or all as long as each other. */
export const kSyncs = ['together', 'own', 'step'] as const
export type Sync = (typeof kSyncs)[number]

/** Seconds that those stand still that are over before the longest, and the longest too, so that the end is seen. */
const kRest = 0.3

/** Seconds after which all begin again; `lengths` are of those that are on the screen. */
export function periodOf(sync: Sync, lengths: readonly number[]): number {
  if (lengths.length === 0) return 1
  if (sync === 'step') return Math.max(0.05, lengths.reduce((sum, one) => sum + one, 0) / lengths.length)
  return Math.max(0.05, ...lengths) + kRest
}

/** Where a loop of this length is when so much time is over since all began, in seconds. Allocates nothing. */
export function timeIn(sync: Sync, clock: number, length: number, period: number): number {
  if (length <= 0) return 0
  if (sync === 'together') return Math.min(length, clock % period)
  if (sync === 'step') return ((clock % period) / period) * length
  return clock % length
}
