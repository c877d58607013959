import type { Report, ReportSign } from '../api/answers'
import type { Declarations } from './declarations'
import type { FrameStore } from './frame_store'
import type { Rig } from './skeleton'

/** Something that gives the frames of a motion, in pieces. */
export interface MotionSource {
  /** What it is called on the screen. */
  readonly title: string
  /** Whether it is known only at the end how long it is. */
  readonly grows: boolean
  /** Whether all frames have come. */
  readonly complete: boolean
  /** Resolves as soon as there is something to show; rejects where there never will be. Called once. */
  open(): Promise<OpenedMotion>
  /** Says where the picture is (seconds from frame 0), so that what is needed next comes next. */
  want?(seconds: number): void
  /** Gives up what is under way. */
  close(): void
  /** Called after each piece, and after the last with `complete` true. */
  onProgress?: (complete: boolean) => void
  /** Called where a piece could not be had: what is there stays. */
  onFault?: (fault: Error) => void
}

/** A motion of which the first frames are there. */
export interface OpenedMotion {
  readonly store: FrameStore
  readonly rig: Rig
  /** The joints' names say left where the body has right: the rig follows the body. */
  readonly swapped?: boolean
  /** Frames a second of the file that these frames are of, where they are not all of them. */
  readonly fileRate?: number
  /** The character whose joints the poses are for; none where they are the recording's own. */
  readonly character?: string
  /** Annotation time of frame 0, in ms. */
  readonly originMs: number
  readonly declarations: Declarations
  /** Of a motion that was made: its signs and where they were recorded. */
  readonly signs?: readonly ReportSign[]
  /** All that is told of how it was made. */
  readonly report?: Report
}
