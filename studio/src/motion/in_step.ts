import type { ReportSign } from '../api/schema'

/** Corresponding times of two motions, in seconds from frame 0 of either; both lists ascend. */
export interface Steps {
  readonly here: Float64Array
  readonly there: Float64Array
}

/**
 * Pairs each sign with the original's sign from which it was made: the k-th with the k-th. `original` are the signs' spans in ms of annotation time, in order.
 */
export function stepsOfSigns(signs: readonly ReportSign[], original: readonly { begin: number; end: number }[], originMs: number): Steps {
  const here: number[] = [0],
    there: number[] = [0]
  const add = (h: number, t: number) => {
    if (h > here[here.length - 1] + 1e-6 && t >= there[there.length - 1]) {
      here.push(h)
      there.push(t)
    }
  }
  signs.slice(0, original.length).forEach((sign, k) => {
    add(sign.begin_ms / 1000, (original[k].begin - originMs) / 1000)
    add(sign.end_ms / 1000, (original[k].end - originMs) / 1000)
  })
  return { here: Float64Array.from(here), there: Float64Array.from(there) }
}

/** Returns the time in the other motion that corresponds to a time in this one. Allocates nothing. */
export function correspondingTime({ here, there }: Steps, seconds: number): number {
  const last = here.length - 1
  if (last < 0 || seconds <= here[0]) return seconds
  if (seconds >= here[last]) return there[last] + (seconds - here[last])
  let low = 0,
    high = last
  while (high - low > 1) {
    const middle = (low + high) >> 1
    if (here[middle] <= seconds) low = middle
    else high = middle
  }
  return there[low] + ((there[high] - there[low]) * (seconds - here[low])) / (here[high] - here[low])
}
