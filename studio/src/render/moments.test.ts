import { describe, expect, it } from 'vitest'
import { chosenMoments, everyMoment, microsecondsOf } from './moments'
import { vp9Codec } from './vp9'

describe('the moments of a video', () => {
  it('are the frames themselves at the motion’s own rate', () => {
    expect([...everyMoment(4, 100, 100).seconds]).toEqual([0, 0.01, 0.02, 0.03])
    expect(everyMoment(4, 100, 100).lasts).toBeCloseTo(0.04)
  })

  it('never lie after the last frame, at any rates', () => {
    for (const [frames, from, to] of [
      [5179, 100, 30],
      [99, 120, 30],
      [10, 30, 60],
      [1, 30, 30],
      [7, 29.97, 30],
      [1000, 30000 / 1001, 24],
    ]) {
      const { seconds } = everyMoment(frames, from, to),
        last = (frames - 1) / from
      expect(seconds[seconds.length - 1]).toBeLessThanOrEqual(last + 1e-6)
      expect(seconds.length / to).toBeGreaterThan(last - 1e-6) // and the next one would
    }
  })

  it('have times without accumulated errors', () => {
    expect([0, 1, 2, 3].map((k) => microsecondsOf(k, 30))).toEqual([0, 33333, 66667, 100000])
    expect(microsecondsOf(1_000_000, 30)).toBe(33333333333)
  })

  it('are rejected outside the motion', () => {
    expect([...chosenMoments(100, 50, [0, 1990, 500]).seconds]).toEqual([0, 1.99, 0.5])
    expect(() => chosenMoments(100, 50, [2001])).toThrow('no frame at 2001 ms: the motion lasts 2000 ms')
    expect(() => chosenMoments(100, 50, [-1])).toThrow('no frame at -1 ms')
  })
})

it('the level of a video permits its frames', () => {
  expect(vp9Codec(1280, 720, 30)).toBe('vp09.00.31.08')
  expect(vp9Codec(1280, 720, 60)).toBe('vp09.00.40.08')
  expect(vp9Codec(3840, 2160, 60)).toBe('vp09.00.51.08')
})
