import { expect, it } from 'vitest'
import { beside, stepsOfSigns } from './in_step'

it('puts the k-th sign beside the k-th sign, and goes evenly between their bounds', () => {
  const sign = (begin_ms: number, end_ms: number) => ({ gloss: 'X', place: 0, clip: 0, begin_ms, end_ms, recording: 'r', recorded: { begin_ms: 0, end_ms: 1 } })
  const steps = stepsOfSigns(
    [sign(1000, 2000), sign(3000, 4000)],
    [
      { begin: 1500, end: 3500 },
      { begin: 3500, end: 4500 },
    ],
    500,
  )
  expect(beside(steps, 1)).toBeCloseTo(1)
  expect(beside(steps, 1.5)).toBeCloseTo(2)
  expect(beside(steps, 2.5)).toBeCloseTo(3)
  expect(beside(steps, 4)).toBeCloseTo(4)
  expect(beside(steps, 6)).toBeCloseTo(6)
})
