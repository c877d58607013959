import type { MotionSource, OpenedMotion } from '../motion/source'
import type { Transport } from './transport'

/** One motion that is shown; the second and later ones go along with the first. */
export interface Strand {
  /** `blind` tells nobody what it is. */
  readonly role: 'only' | 'original' | 'made' | 'beside' | 'blind'
  readonly source: MotionSource
  readonly motion: OpenedMotion
}

/** What the viewer shows: motions, and the time that they are at. */
export interface Showing {
  readonly transport: Transport
  readonly strands: readonly Strand[]
  /** All are seen through the camera of the first, so that nothing but the motion tells them apart. */
  readonly oneCamera?: boolean
  /** Rises as pieces of the motions come. */
  readonly arrivals: number
  /** The time of a strand beside a time of the transport, both in seconds from frame 0. */
  timeOf(strand: Strand): (seconds: number) => number
}
