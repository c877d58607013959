import type { Media } from '../annotation/document'

/**
 * The address of a linked video that this page may play: one of the server's own. The API has no way yet to send a recording's
 * media, so that paths of files are none; when it has, this is the place.
 */
export function playable(media: Media): string | undefined {
  if (!/^https?:/.test(media.url)) return undefined
  return new URL(media.url).origin === location.origin ? media.url : undefined
}

/**
 * Time of the video, in seconds, at a time of the motion in seconds from frame 0. `originMs` is the annotation time of frame 0,
 * `mediaOriginMs` the video's time at annotation time 0.
 */
export function videoTime(seconds: number, originMs: number, mediaOriginMs: number): number {
  return seconds + (originMs + mediaOriginMs) / 1000
}

/** Of the files that an annotation links the one that is video; none where there is none. */
export function videoOf(media: readonly Media[]): Media | undefined {
  return media.find(({ mime }) => mime.startsWith('video/')) ?? media.find(({ mime }) => !mime.startsWith('audio/'))
}

/** The name of a linked file, without its folders. */
export function nameOf({ url }: Media): string {
  return url.split(/[/\\]/).pop() || url
}
