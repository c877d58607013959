import type { Place } from './project'
import { sameSign } from './project'

/** Places between the first and the last that changed are compared one with another; of more than so many only by their order. */
const kMostCompared = 400

/**
 * Places that were read from a text take over, from those that were there, what a text does not hold: which place they are, and how
 * they are joined. Those that ask for the same sign are the same place, as many as can be in order.
 */
export function carried(before: readonly Place[], read: readonly Place[]): Place[] {
  // Before the first place a text says nothing, so that what waits there stays.
  const take = (old: Place, fresh: Place): Place => ({ ...fresh, id: old.id, join: old.join, pause: fresh === read[0] ? old.pause : fresh.pause })
  const result = [...read]
  let from = 0
  while (from < before.length && from < read.length && sameSign(before[from], read[from])) {
    result[from] = take(before[from], read[from])
    ++from
  }
  let oldEnd = before.length,
    end = read.length
  while (oldEnd > from && end > from && sameSign(before[oldEnd - 1], read[end - 1])) {
    --oldEnd
    --end
    result[end] = take(before[oldEnd], read[end])
  }
  const old = before.slice(from, oldEnd),
    fresh = read.slice(from, end)
  for (const [o, f] of pairs(old, fresh)) result[from + f] = take(old[o], fresh[f])
  return result
}

/** Places of both lists that ask for the same sign, as many as there can be in the order of both. */
function pairs(old: readonly Place[], fresh: readonly Place[]): [number, number][] {
  // One word retyped is the same place with another sign.
  if (old.length === 1 && fresh.length === 1) return [[0, 0]]
  if (old.length > kMostCompared || fresh.length > kMostCompared) return []
  const longest = Array.from({ length: old.length + 1 }, () => new Uint16Array(fresh.length + 1))
  for (let o = old.length - 1; o >= 0; --o) {
    for (let f = fresh.length - 1; f >= 0; --f) {
      longest[o][f] = sameSign(old[o], fresh[f]) ? longest[o + 1][f + 1] + 1 : Math.max(longest[o + 1][f], longest[o][f + 1])
    }
  }
  const found: [number, number][] = []
  for (let o = 0, f = 0; o < old.length && f < fresh.length;) {
    if (sameSign(old[o], fresh[f])) found.push([o++, f++])
    else if (longest[o + 1][f] >= longest[o][f + 1]) ++o
    else ++f
  }
  return found
}
