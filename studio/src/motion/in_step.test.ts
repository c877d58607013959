import { expect, it } from 'vitest'
import { signAnswer } from '../api/test_answers'
import { correspondingTime, stepsOfSigns } from './in_step'

it('pairs the k-th sign with the k-th sign, and interpolates between their bounds', () => {
  const sign = (begin_ms: number, end_ms: number) => signAnswer({ begin_ms, end_ms })
  const steps = stepsOfSigns(
    [sign(1000, 2000), sign(3000, 4000)],
    [
      { begin: 1500, end: 3500 },
      { begin: 3500, end: 4500 },
    ],
    500,
  )
  expect(correspondingTime(steps, 1)).toBeCloseTo(1)
  expect(correspondingTime(steps, 1.5)).toBeCloseTo(2)
  expect(correspondingTime(steps, 2.5)).toBeCloseTo(3)
  expect(correspondingTime(steps, 4)).toBeCloseTo(4)
  expect(correspondingTime(steps, 6)).toBeCloseTo(6)
})
