import { expect, it } from 'vitest'
import { clock } from './clock'

it('formats minutes, seconds and the requested digits, also for negative times', () => {
  expect([0, 61.0004, 59.9996, 600].map((s) => clock(s))).toEqual(['0:00.000', '1:01.000', '1:00.000', '10:00.000'])
  expect([-0.12, -75, -0.0001].map((s) => clock(s, 2))).toEqual(['−0:00.12', '−1:15.00', '0:00.00'])
  expect(clock(59.6, 0)).toBe('1:00')
})
