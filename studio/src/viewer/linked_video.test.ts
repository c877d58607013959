import { expect, it } from 'vitest'
import { videoOf, videoTime } from './linked_video'

const media = (file: string, mime: string) => ({ file, mime, origin_ms: 0, url: null })

it('takes the video among the linked files, not the audio', () => {
  const sound = media('a.wav', 'audio/x-wav'),
    film = media('a.mp4', 'video/mp4'),
    unknown = media('a.x', '')
  expect(videoOf([sound, unknown, film])).toBe(film)
  expect(videoOf([sound, unknown])).toBe(unknown)
  expect(videoOf([sound])).toBeUndefined()
})

it('follows annotation time: the video begins at its origin', () => {
  expect(videoTime(2, 100, 250)).toBeCloseTo(2.35)
})
