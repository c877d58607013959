import type { Place } from './project'
import { sameSign } from './project'

/** Up to this many changed places are compared with one another; beyond that, places are matched by their order only. */
const kMostCompared = 400

/**
 * Transfers what a text does not hold, the ids and joins, from existing places to places read from a text. Places for the same sign are matched, as many as can
 * be in order.
 */
export function carried(before: readonly Place[], read: readonly Place[]): Place[] {
  // A text holds no pause or join before the first place, so these are preserved there.
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

/** Returns the longest common subsequence of both lists: pairs of places for the same sign. */
function pairs(old: readonly Place[], fresh: readonly Place[]): [number, number][] {
  // A retyped word is the same place with another sign.
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
