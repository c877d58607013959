import type { MotionSource, OpenedMotion } from '../motion/source'
import type { Transport } from './transport'

/** One motion on display; the second and later ones follow the first. */
export interface Strand {
  /** `blind` reveals nothing about the motion. */
  readonly role: 'only' | 'original' | 'made' | 'compared' | 'blind'
  readonly source: MotionSource
  readonly motion: OpenedMotion
}

/** The content of the viewer: motions, and their current time. */
export interface Showing {
  readonly transport: Transport
  readonly strands: readonly Strand[]
  /** All are seen through the camera of the first, so that they differ in nothing but the motion. */
  readonly oneCamera?: boolean
  /** Increases as pieces of the motions arrive. */
  readonly arrivals: number
  /** Returns the mapping from the transport's time to a strand's time, both in seconds from frame 0. */
  timeOf(strand: Strand): (seconds: number) => number
}
