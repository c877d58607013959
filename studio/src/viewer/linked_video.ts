import type { MediaRow } from '../api/schema'

/**
 * Returns the time of the video in seconds for a time of the motion in seconds from frame 0. `originMs` is the annotation time of frame 0, `mediaOriginMs` the
 * video's time at annotation time 0.
 */
export function videoTime(seconds: number, originMs: number, mediaOriginMs: number): number {
  return seconds + (originMs + mediaOriginMs) / 1000
}

/** Returns the video among the linked media: one declared as video, otherwise the first that is not audio. */
export function videoOf(media: readonly MediaRow[]): MediaRow | undefined {
  return media.find(({ mime }) => mime.startsWith('video/')) ?? media.find(({ mime }) => !mime.startsWith('audio/'))
}
