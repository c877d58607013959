import type { FrameStore } from '../motion/frame_store'

/** The curves below the tiers; all are of the wrists, in model space (Y up), metres and metres a second. */
export const kCurves = ['height', 'sideways', 'depth', 'handSpeed'] as const
export type Curve = (typeof kCurves)[number]

const kAxis = { sideways: 0, height: 1, depth: 2 } as const

export function valueAt(store: FrameStore, curve: Curve, frame: number, hand: 0 | 1): number {
  return curve === 'handSpeed' ? store.speed(frame, hand) : store.hand(frame, hand, kAxis[curve])
}

export interface Extent {
  readonly low: number
  readonly high: number
}

/** Returns the least and greatest value of both hands over the loaded frames, sampled every `stride` frames, with a margin. */
export function extentOf(store: FrameStore, curve: Curve, stride = Math.max(1, Math.floor(store.length / 2000))): Extent {
  let low = curve === 'handSpeed' ? 0 : Infinity,
    high = curve === 'handSpeed' ? 0.5 : -Infinity
  for (let frame = 0; frame < store.length; frame += stride) {
    for (const hand of [0, 1] as const) {
      const value = valueAt(store, curve, frame, hand)
      if (value < low) low = value
      if (value > high) high = value
    }
  }
  if (!(high > low)) return { low: 0, high: 1 }
  const margin = 0.06 * (high - low)
  return { low: curve === 'handSpeed' ? 0 : low - margin, high: high + margin }
}
