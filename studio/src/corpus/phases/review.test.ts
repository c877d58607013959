import { expect, it } from 'vitest'
import { begun, pushed, redone, undone } from './history'
import {
  acceptedAll,
  addedTo,
  decided,
  faultsOf,
  filled,
  find,
  following,
  frameOf,
  inOrder,
  kEmpty,
  merged,
  moved,
  msOf,
  progressOf,
  put,
  retyped,
  reviewOf,
  split,
  stepped,
  within,
  type Frames,
  type Review,
} from './review'

/** 30 frames a second: only every third frame begins at a whole ms. */
const kFrames: Frames = { originMs: 0, rate: 30, count: 300 }
const phase = (hand: 'right' | 'left', kind: string, begin: number, end: number) => ({ hand, kind, begin, end, state: 'open' as const })
/** Right: 0–1000 and 1000–2000 touch, 3000–4000 is isolated; left: 500–1500. */
const kReview: Review = [
  phase('right', 'preparation', 0, 1000),
  phase('right', 'stroke', 1000, 2000),
  phase('right', 'retraction', 3000, 4000),
  phase('left', 'stroke', 500, 1500),
].reduce(put, kEmpty)
const spans = (review: Review, hand: 'right' | 'left' = 'right') => review.phases[hand].map(({ begin, end }) => [begin, end])
const sound = (review: Review) => {
  expect(faultsOf(review)).toEqual([])
  return review
}

it('reads proposals at whole frames, in annotation time, without rests', () => {
  const hands = {
    right: [
      { phase: 'rest', begin_ms: 0, end_ms: 500, confidence: 1 },
      { phase: 'stroke', begin_ms: 510, end_ms: 1005, confidence: 0.7 },
      { phase: 'hold', begin_ms: 1005, end_ms: 1010, confidence: 0.5 },
      { phase: 'retraction', begin_ms: 1010, end_ms: 99_999, confidence: 0.5 },
    ],
    left: [],
  }
  const review = sound(reviewOf({ proposed: '', hands }, { ...kFrames, originMs: -100 }))
  // A hold of a third of a frame is dropped; nothing extends beyond the motion.
  expect(review.phases.right.map(({ kind, begin, end }) => [kind, begin, end])).toEqual([
    ['stroke', 400, 900],
    ['retraction', 900, 9900],
  ])
  expect(review.phases.right[0].confidence).toBe(0.7)
})

it('converts frames to ms and back, never below 0', () => {
  for (let frame = 0; frame <= 300; ++frame) expect(frameOf(msOf(frame, kFrames), kFrames)).toBe(frame)
  expect([msOf(-1, kFrames), msOf(301, kFrames), msOf(0, { ...kFrames, originMs: -50 })]).toEqual([0, 10_000, 0])
})

it('steps through both hands by time, and finds open phases', () => {
  expect(inOrder(kReview).map(({ id }) => id)).toEqual([1, 4, 2, 3])
  expect([undefined, 1, 3].map((id) => following(kReview, id, 1)?.id)).toEqual([1, 4, undefined])
  expect([undefined, 4].map((id) => following(kReview, id, -1)?.id)).toEqual([3, 1])
  const some = decided(decided(kReview, 4, 'accepted'), 2, 'rejected')
  expect([1, 3].map((id) => following(some, id, 1, true)?.id)).toEqual([3, 1])
  expect(following(acceptedAll(kReview), 1, 1, true)).toBeUndefined()
})

it('accepts, rejects, reopens and changes kinds', () => {
  const some = sound(retyped(decided(decided(kReview, 1, 'accepted'), 2, 'rejected'), 3, 'hold'))
  expect(progressOf(some)).toEqual({ all: 4, accepted: 1, rejected: 1, open: 2, unseen: 0 })
  expect(find(some, 3)?.kind).toBe('hold')
  expect(progressOf(acceptedAll(some))).toEqual({ all: 4, accepted: 3, rejected: 1, open: 0, unseen: 2 })
  expect(find(decided(some, 2, 'open'), 2)?.state).toBe('open')
})

it('moves a shared border of two phases for both', () => {
  expect(spans(sound(stepped(kReview, 1, 'end', 1, kFrames)))).toEqual([
    [0, 1033],
    [1033, 2000],
    [3000, 4000],
  ])
  expect(spans(sound(stepped(kReview, 2, 'begin', -10, kFrames)))).toEqual([
    [0, 667],
    [667, 2000],
    [3000, 4000],
  ])
  // The other hand's phases are unchanged.
  expect(spans(stepped(kReview, 2, 'begin', -10, kFrames), 'left')).toEqual([[500, 1500]])
})

it('moves into a gap, and then pushes the neighbour', () => {
  expect(spans(sound(moved(kReview, 2, 'end', 2500, kFrames)))).toEqual([
    [0, 1000],
    [1000, 2500],
    [3000, 4000],
  ])
  expect(spans(sound(moved(kReview, 2, 'end', 3500, kFrames)))).toEqual([
    [0, 1000],
    [1000, 3500],
    [3500, 4000],
  ])
  expect(spans(sound(moved(kReview, 3, 'begin', 1500, kFrames)))).toEqual([
    [0, 1000],
    [1000, 1500],
    [1500, 4000],
  ])
})

it('leaves at least one frame to every phase, and nothing beyond the motion', () => {
  expect(spans(sound(moved(kReview, 1, 'end', 9000, kFrames)))).toEqual([
    [0, 1967],
    [1967, 2000],
    [3000, 4000],
  ])
  expect(spans(sound(moved(kReview, 1, 'end', -50, kFrames)))).toEqual([
    [0, 33],
    [33, 2000],
    [3000, 4000],
  ])
  expect(spans(sound(moved(kReview, 3, 'end', 99_999, kFrames)))[2]).toEqual([3000, 10_000])
  expect(spans(sound(moved(kReview, 1, 'begin', -99, kFrames)))[0]).toEqual([0, 1000])
  expect(moved(kReview, 1, 'begin', 0, kFrames)).toBe(kReview)
  expect(moved(kReview, 99, 'begin', 10, kFrames)).toBe(kReview)
})

it('splits at a frame, and merges with the next', () => {
  const two = sound(split(kReview, 2, 1510, kFrames))
  expect(spans(two)).toEqual([
    [0, 1000],
    [1000, 1500],
    [1500, 2000],
    [3000, 4000],
  ])
  expect(two.phases.right.map(({ id, kind }) => [id, kind])).toEqual([
    [1, 'preparation'],
    [2, 'stroke'],
    [5, 'stroke'],
    [3, 'retraction'],
  ])
  expect(split(kReview, 2, 1005, kFrames)).toBe(kReview)
  expect(spans(sound(merged(two, 2)))).toEqual(spans(kReview))
  // Across a gap, too; phases decided differently become open.
  const over = sound(merged(decided(kReview, 2, 'accepted'), 2))
  expect(spans(over)).toEqual([
    [0, 1000],
    [1000, 4000],
  ])
  expect(find(over, 2)).toEqual({ id: 2, hand: 'right', kind: 'stroke', begin: 1000, end: 4000, state: 'open' })
  expect(merged(kReview, 3)).toBe(kReview)
})

it('adds a phase in a gap', () => {
  const more = sound(addedTo(kReview, 'right', 'stroke', { begin: 2500, end: 3400 }, kFrames))
  expect(spans(more)).toEqual([
    [0, 1000],
    [1000, 2000],
    [2500, 3000],
    [3000, 4000],
  ])
  expect(find(more, 5)?.state).toBe('accepted')
  expect(addedTo(kReview, 'right', 'stroke', { begin: 1500, end: 2500 }, kFrames)).toBe(kReview)
})

it('fills gaps with proposals, cut at existing phases', () => {
  const more = [phase('right', 'hold', 500, 3500), phase('left', 'hold', 600, 700), phase('right', 'stroke', 5000, 6000)].reduce(put, kEmpty)
  const all = sound(filled(kReview, more))
  expect(spans(all)).toEqual([
    [0, 1000],
    [1000, 2000],
    [2000, 3000],
    [3000, 4000],
    [5000, 6000],
  ])
  expect(spans(all, 'left')).toEqual([[500, 1500]])
})

it("keeps the parts of another motion's review for which there are frames", () => {
  const short = sound(within(decided(kReview, 2, 'accepted'), { originMs: 0, rate: 25, count: 40 }))
  expect([spans(short), spans(short, 'left')]).toEqual([
    [
      [0, 1000],
      [1000, 1600],
    ],
    [[520, 1520]],
  ])
  expect(short.phases.right[1].state).toBe('accepted')
})

it('undoes and redoes', () => {
  let history = begun(kReview)
  history = pushed(history, decided(kReview, 1, 'accepted'))
  history = pushed(history, history.now)
  history = pushed(history, decided(history.now, 2, 'rejected'))
  expect(history.past.length).toBe(2)
  history = undone(undone(undone(history)))
  expect(history.now).toBe(kReview)
  expect(progressOf(redone(redone(redone(history))).now)).toEqual({ all: 4, accepted: 1, rejected: 1, open: 2, unseen: 0 })
  expect(pushed(redone(history), decided(kReview, 3, 'accepted')).undone).toEqual([])
})

it('keeps its invariants through a thousand random operations', () => {
  let review = kReview,
    seed = 1
  const random = (below: number) => (seed = (seed * 16807) % 2147483647) % below
  for (let i = 0; i < 1000; ++i) {
    const all = inOrder(review),
      { id } = all[random(all.length)],
      at = random(10_000)
    const next = [
      () => moved(review, id, random(2) ? 'begin' : 'end', at, kFrames),
      () => stepped(review, id, 'end', random(21) - 10, kFrames),
      () => split(review, id, at, kFrames),
      () => (all.length > 3 ? merged(review, id) : review),
      () => addedTo(review, random(2) ? 'right' : 'left', 'hold', { begin: at, end: at + 500 }, kFrames),
    ][random(5)]
    review = sound(next())
  }
})

it('remembers what was accepted with all others, until it is decided or changed individually', () => {
  const all = acceptedAll(decided(kReview, 1, 'accepted')),
    ids = inOrder(all).map(({ id }) => id)
  const unseen = (review: typeof all) =>
    inOrder(review)
      .filter((one) => one.unseen)
      .map(({ id }) => id)
  expect(unseen(all)).toEqual(ids.filter((id) => id !== 1))
  const [id] = unseen(all)
  for (const next of [decided(all, id, 'accepted'), retyped(all, id, 'hold'), stepped(all, id, 'end', -1, kFrames)]) expect(unseen(next)).not.toContain(id)
  expect(unseen(within(all, kFrames)).length).toBe(unseen(all).length)
})
