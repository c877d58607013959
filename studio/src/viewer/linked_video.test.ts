import { expect, it } from 'vitest'
import { nameOf, videoOf, videoTime } from './linked_video'

const media = (url: string, mime: string) => ({ url, mime, originMs: 0 })

it('takes the video among the files that are linked, not the sound', () => {
  const sound = media('a.wav', 'audio/x-wav'), film = media('a.mp4', 'video/mp4'), unknown = media('a.x', '')
  expect(videoOf([sound, film])).toBe(film)
  expect(videoOf([sound, unknown])).toBe(unknown)
  expect(videoOf([sound])).toBeUndefined()
  expect(nameOf(media('file:///C:\\films\\a.mp4', ''))).toBe('a.mp4')
})

it('keeps to annotation time: the video begins where its origin says', () => {
  expect(videoTime(2, 100, 250)).toBeCloseTo(2.35)
})
