/** How loops run in parallel: all begin at once and wait for the longest, each by itself, or all stretched to the same length. */
export const kSyncs = ['together', 'own', 'step'] as const
export type Sync = (typeof kSyncs)[number]

/** Seconds for which loops pause at their end, including the longest, so that the end can be seen. */
const kRest = 0.3

/** Seconds after which all restart; `lengths` are those of the visible loops. */
export function periodOf(sync: Sync, lengths: readonly number[]): number {
  if (lengths.length === 0) return 1
  if (sync === 'step') return Math.max(0.05, lengths.reduce((sum, one) => sum + one, 0) / lengths.length)
  return Math.max(0.05, ...lengths) + kRest
}

/** Returns the position in a loop of this length when `clock` seconds have passed since all began. Allocates nothing. */
export function timeIn(sync: Sync, clock: number, length: number, period: number): number {
  if (length <= 0) return 0
  if (sync === 'together') return Math.min(length, clock % period)
  if (sync === 'step') return ((clock % period) / period) * length
  return clock % length
}
