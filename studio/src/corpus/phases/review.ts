import type { Proposals } from '../../api/schema'

export type Hand = 'right' | 'left'
export const kHands: readonly Hand[] = ['right', 'left']
/** The kinds of phases, in the order of a movement. */
export const kKinds = ['preparation', 'stroke', 'hold', 'retraction'] as const
export type State = 'open' | 'accepted' | 'rejected'
export type Edge = 'begin' | 'end'

/** A phase of one hand under review; annotation time in whole ms, half-open. `kind` is one of kKinds, or the label in a file. */
export interface Phase {
  readonly id: number
  readonly hand: Hand
  readonly kind: string
  readonly begin: number
  readonly end: number
  readonly state: State
  /** For a proposal: the mean probability of its kind. */
  readonly confidence?: number
  /** Accepted together with all others, so that perhaps no person has looked at it. Deciding about it or changing it resets this. */
  readonly unseen?: boolean
}
/** The phases of both hands, ordered by time for each hand, without overlaps. Immutable: every operation returns a new one. */
export interface Review {
  readonly phases: Readonly<Record<Hand, readonly Phase[]>>
  /** The next phase's id. */ readonly next: number
}
export const kEmpty: Review = { phases: { right: [], left: [] }, next: 1 }

/** The frames of the motion in annotation time. */
export interface Frames {
  readonly originMs: number
  readonly rate: number
  readonly count: number
}
/**
 * Returns the begin of a frame in whole ms, as in EAF; the frame is clamped to the motion, or to its end. The result is at least 0, because EAF has no negative
 * times.
 */
export function msOf(frame: number, { originMs, rate, count }: Frames): number {
  return Math.max(0, Math.round(originMs + (1000 * Math.min(Math.max(0, frame), count)) / rate))
}
export const frameOf = (ms: number, { originMs, rate, count }: Frames) => Math.min(count, Math.max(0, Math.round(((ms - originMs) * rate) / 1000)))
const snapped = (ms: number, frames: Frames) => msOf(frameOf(ms, frames), frames)

/** Returns the segmenter's proposals, at whole frames. Its rests become the gaps between phases. */
export function reviewOf({ hands }: Proposals, frames: Frames): Review {
  let review = kEmpty
  for (const hand of kHands) {
    for (const { phase, begin_ms, end_ms, confidence } of hands[hand] ?? []) {
      if (phase === 'rest') continue
      const begin = snapped(begin_ms + frames.originMs, frames),
        end = snapped(end_ms + frames.originMs, frames)
      if (end > begin) review = put(review, { hand, kind: phase, begin, end, state: 'open', confidence })
    }
  }
  return review
}

/** Returns all phases of both hands in the order of time. */
export function inOrder({ phases }: Review): readonly Phase[] {
  return [...phases.right, ...phases.left].sort((a, b) => a.begin - b.begin || (a.hand === b.hand ? 0 : a.hand === 'right' ? -1 : 1))
}
export const find = ({ phases }: Review, id: number | undefined): Phase | undefined =>
  phases.right.find((one) => one.id === id) ?? phases.left.find((one) => one.id === id)

/** Returns the phase after one (direction 1) or before it (−1) in time; with `open`, the next undecided one, wrapping around at the end. */
export function following(review: Review, id: number | undefined, direction: 1 | -1, open = false): Phase | undefined {
  const all = inOrder(review),
    at = all.findIndex((one) => one.id === id)
  if (!open) return all[at < 0 ? (direction > 0 ? 0 : all.length - 1) : at + direction]
  return [...all.slice(at + 1), ...all.slice(0, Math.max(0, at))].find(({ state }) => state === 'open')
}

export interface Progress {
  readonly all: number
  readonly accepted: number
  readonly rejected: number
  readonly open: number
  /** Among the accepted ones. */ readonly unseen: number
}
export function progressOf(review: Review): Progress {
  const all = inOrder(review),
    count = (wanted: State) => all.filter(({ state }) => state === wanted).length
  return { all: all.length, accepted: count('accepted'), rejected: count('rejected'), open: count('open'), unseen: all.filter((one) => one.unseen).length }
}

export const decided = (review: Review, id: number, state: State) => changed(review, id, { state, unseen: undefined })
export const retyped = (review: Review, id: number, kind: string) => changed(review, id, { kind, unseen: undefined })
/** Accepts all undecided phases, and marks them as accepted unseen. */
export function acceptedAll({ phases, next }: Review): Review {
  const accept = (list: readonly Phase[]) => list.map((one): Phase => (one.state === 'open' ? { ...one, state: 'accepted', unseen: true } : one))
  return { phases: { right: accept(phases.right), left: accept(phases.left) }, next }
}

/**
 * Moves a begin or an end to the nearest frame. A touching border moves along, phases in the way are shortened, and every phase keeps at least one frame: the
 * border stops where its neighbour would become empty.
 */
export function moved(review: Review, id: number, edge: Edge, ms: number, frames: Frames): Review {
  const one = find(review, id)
  if (!one) return review
  const list = review.phases[one.hand],
    at = list.indexOf(one)
  const other = list[edge === 'begin' ? at - 1 : at + 1]
  const low = edge === 'begin' ? (other ? after(other.begin, frames) : msOf(0, frames)) : after(one.begin, frames)
  const high = edge === 'begin' ? before(one.end, frames) : other ? before(other.end, frames) : msOf(frames.count, frames)
  const to = Math.min(high, Math.max(low, snapped(ms, frames)))
  if (to === one[edge] || low > high) return review
  const far: Edge = edge === 'begin' ? 'end' : 'begin'
  const touched = other && (other[far] === one[edge] || (edge === 'begin' ? other.end > to : other.begin < to))
  const next = changed(review, id, { [edge]: to, unseen: undefined })
  return touched ? changed(next, other.id, { [far]: to }) : next
}
/** Moves a begin or an end by whole frames. */
export function stepped(review: Review, id: number, edge: Edge, by: number, frames: Frames): Review {
  const one = find(review, id)
  return one ? moved(review, id, edge, msOf(frameOf(one[edge], frames) + by, frames), frames) : review
}
const after = (ms: number, frames: Frames) => msOf(frameOf(ms, frames) + 1, frames)
const before = (ms: number, frames: Frames) => msOf(frameOf(ms, frames) - 1, frames)

/** Splits a phase at the nearest frame; changes nothing if one part would be empty. The second part gets a new id. */
export function split(review: Review, id: number, ms: number, frames: Frames): Review {
  const one = find(review, id),
    at = snapped(ms, frames)
  if (!one || at <= one.begin || at >= one.end) return review
  return put(changed(review, id, { end: at, unseen: undefined }), { ...one, begin: at, unseen: undefined })
}
/** Merges a phase with the next one of its hand, including the gap between them. The result has the first one's kind; if their states differ, it is open. */
export function merged(review: Review, id: number): Review {
  const one = find(review, id)
  if (!one) return review
  const list = review.phases[one.hand],
    other = list[list.indexOf(one) + 1]
  if (!other) return review
  const { confidence, unseen, ...rest } = one
  const whole: Phase = {
    ...rest,
    end: other.end,
    state: one.state === other.state ? one.state : 'open',
    ...(confidence !== undefined && confidence === other.confidence ? { confidence } : {}),
  }
  return { ...review, phases: { ...review.phases, [one.hand]: list.filter((each) => each !== other).map((each) => (each === one ? whole : each)) } }
}
/** Adds an accepted phase in a gap of a hand: the part of the span that is free around its begin; changes nothing if the begin is not free. */
export function addedTo(review: Review, hand: Hand, kind: string, span: { readonly begin: number; readonly end: number }, frames: Frames): Review {
  const begin = snapped(span.begin, frames),
    list = review.phases[hand]
  if (list.some((one) => one.begin <= begin && begin < one.end)) return review
  const end = Math.min(snapped(span.end, frames), list.find((one) => one.begin > begin)?.begin ?? Infinity)
  return end > begin ? put(review, { hand, kind, begin, end, state: 'accepted' }) : review
}
/** Adds phases of `more` where this review has none; parts that overlap existing phases are cut off. */
export function filled(review: Review, more: Review): Review {
  let result = review
  for (const one of inOrder(more)) {
    const around = result.phases[one.hand].filter((other) => other.begin < one.end && one.begin < other.end)
    let { begin } = one
    for (const { begin: from, end: to } of [...around, { begin: one.end, end: one.end }]) {
      if (from > begin) result = put(result, { ...one, begin, end: from })
      begin = Math.max(begin, to)
    }
  }
  return result
}

/** Fits a review of another motion to the frames of this one. */
export function within(review: Review, frames: Frames): Review {
  let result = kEmpty
  for (const one of inOrder(review)) {
    const begin = snapped(one.begin, frames),
      end = snapped(one.end, frames)
    if (end > begin) result = put(result, { ...one, begin, end })
  }
  return result
}

/** Adds another phase, which must lie in a gap. */
export function put({ phases, next }: Review, { hand, kind, begin, end, state, confidence, unseen }: Omit<Phase, 'id'>): Review {
  const one: Phase = { id: next, hand, kind, begin, end, state, ...(confidence === undefined ? {} : { confidence }), ...(unseen ? { unseen } : {}) }
  return { phases: { ...phases, [hand]: [...phases[hand], one].sort((a, b) => a.begin - b.begin) }, next: next + 1 }
}

function changed(review: Review, id: number, change: Partial<Phase>): Review {
  const of = (list: readonly Phase[]) => (list.some((one) => one.id === id) ? list.map((one) => (one.id === id ? { ...one, ...change } : one)) : list)
  return { ...review, phases: { right: of(review.phases.right), left: of(review.phases.left) } }
}

/** Returns the faults of a review from outside; empty if it is valid. */
export function faultsOf({ phases, next }: Review): readonly string[] {
  const faults: string[] = []
  const ids = new Set<number>()
  for (const hand of kHands) {
    phases[hand].forEach((one, at) => {
      const { id, begin, end } = one,
        last = phases[hand][at - 1]
      if (one.hand !== hand || ids.has(id) || id >= next) faults.push(`id ${id}`)
      if (!Number.isInteger(begin) || !Number.isInteger(end) || begin < 0 || end <= begin) faults.push(`span ${begin}..${end}`)
      if (last && last.end > begin) faults.push(`overlap at ${begin}`)
      ids.add(id)
    })
  }
  return faults
}
