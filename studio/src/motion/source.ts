import type { ReportSign, Synthesis } from '../api/schema'
import type { Declarations } from './declarations'
import type { FrameStore } from './frame_store'
import type { Rig } from './skeleton'

/** Provides the frames of a motion, in pieces. */
export interface MotionSource {
  /** The name on the screen. */
  readonly title: string
  /** Whether the length is known only at the end. */
  readonly grows: boolean
  /** Whether all frames have arrived. */
  readonly complete: boolean
  /** Resolves as soon as there is something to show; rejects if there never will be. Called once. */
  open(): Promise<OpenedMotion>
  /** Sets the current time (seconds from frame 0), so that the frames needed next arrive next. */
  want?(seconds: number): void
  /** Cancels what is in progress. */
  close(): void
  /** Called after each piece, and after the last with `complete` true. */
  onProgress?: (complete: boolean) => void
  /** Called if a piece could not be loaded: loaded frames stay. */
  onFault?: (fault: Error) => void
}

/** A motion whose first frames are loaded. */
export interface OpenedMotion {
  readonly store: FrameStore
  readonly rig: Rig
  /** The joints' names say left where the body has right: the rig follows the body. */
  readonly swapped?: boolean
  /** Frame rate of the file from which these frames are, if they are not all of them. */
  readonly fileRate?: number
  /** The character whose joints the poses are for; undefined for the recording's own. */
  readonly character?: string
  /** Annotation time of frame 0, in ms. */
  readonly originMs: number
  readonly declarations: Declarations
  /** For generated motion: its signs and where they were recorded. */
  readonly signs?: readonly ReportSign[]
  /** The full report of how it was generated. */
  readonly report?: Synthesis
}
