import { expect, it } from 'vitest'
import { videoOf, videoTime } from './linked_video'

const media = (file: string, mime: string) => ({ file, mime, origin_ms: 0, url: null })

it('takes the video among the files that are linked, not the sound', () => {
  const sound = media('a.wav', 'audio/x-wav'),
    film = media('a.mp4', 'video/mp4'),
    unknown = media('a.x', '')
  expect(videoOf([sound, unknown, film])).toBe(film)
  expect(videoOf([sound, unknown])).toBe(unknown)
  expect(videoOf([sound])).toBeUndefined()
})

it('keeps to annotation time: the video begins where its origin says', () => {
  expect(videoTime(2, 100, 250)).toBeCloseTo(2.35)
})
