import type { AnnotationDocument, Tier } from '../../annotation/document'
import type { Borders } from '../../timeline/borders'
import { kHands, type Edge, type Hand, type Phase, type Review } from './review'

/** Returns the rows of the timeline: one for each hand, and the annotation below them. */
export function rowsOf(
  review: Review,
  current: number | undefined,
  document: AnnotationDocument,
  names: Readonly<Record<Hand, string>>,
  kinds: Readonly<Record<string, string>>,
): AnnotationDocument {
  const rows = kHands.map((hand): Tier => ({
    name: names[hand],
    depth: 1,
    annotations: review.phases[hand].map(({ id, begin, end, kind, state, unseen }) => ({
      begin,
      end,
      label: kinds[kind] ?? kind,
      state: unseen ? ('unseen' as const) : state,
      current: id === current,
    })),
  }))
  return { tiers: [...rows, ...document.tiers] }
}

/** Returns the phase in a row. */
export const phaseAt = (review: Review, tier: number, at: number): Phase | undefined => (kHands[tier] ? review.phases[kHands[tier]][at] : undefined)

/**
 * Returns the border nearest to a time, within reach; if two phases touch there, that of the current phase, otherwise that of the phase on the side of the
 * time.
 */
export function edgeNear(review: Review, tier: number, ms: number, reach: number, current?: number): { readonly id: number; readonly edge: Edge } | undefined {
  let best: { id: number; edge: Edge } | undefined,
    least = reach
  for (const { id, begin, end } of kHands[tier] ? review.phases[kHands[tier]] : []) {
    for (const [edge, at] of [
      ['begin', begin],
      ['end', end],
    ] as const) {
      const far = Math.abs(at - ms) - (id === current ? 1e-3 : 0) - ((edge === 'begin') === ms >= at ? 1e-6 : 0)
      if (far <= least) [best, least] = [{ id, edge }, far]
    }
  }
  return best
}

/** Returns borders for the timeline: `move` is called during a drag, `done` when it ends. */
export function bordersOf(
  review: () => Review,
  current: () => number | undefined,
  move: (id: number, edge: Edge, ms: number) => void,
  done: () => void,
): Borders {
  let held: { id: number; edge: Edge } | undefined
  return {
    isNear: (tier, ms, reach) => edgeNear(review(), tier, ms, reach) !== undefined,
    grab: (tier, ms, reach) => (held = edgeNear(review(), tier, ms, reach, current())) !== undefined,
    drag: (ms) => {
      if (held) move(held.id, held.edge, ms)
    },
    drop: () => {
      held = undefined
      done()
    },
  }
}
