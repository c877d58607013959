import type { MediaRow } from '../api/answers'

/**
 * Time of the video, in seconds, at a time of the motion in seconds from frame 0. `originMs` is the annotation time of frame 0,
 * `mediaOriginMs` the video's time at annotation time 0.
 */
export function videoTime(seconds: number, originMs: number, mediaOriginMs: number): number {
  return seconds + (originMs + mediaOriginMs) / 1000
}

/** The film among what is linked: one that says it is, else the first that is no sound. */
export function videoOf(media: readonly MediaRow[]): MediaRow | undefined {
  return media.find(({ mime }) => mime.startsWith('video/')) ?? media.find(({ mime }) => !mime.startsWith('audio/'))
}
