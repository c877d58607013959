import { expect, it } from 'vitest'
import { nextPiece } from './recording_source'

it('requests a short piece first, and longer ones up to a limit', () => {
  expect(nextPiece(200, 5179, 100, 0)).toEqual({ first: 200, end: 225 })
  expect(nextPiece(225, 5179, 100, 1)).toEqual({ first: 225, end: 275 })
  expect(nextPiece(1000, 5179, 100, 9)).toEqual({ first: 1000, end: 1400 })
  expect(nextPiece(5170, 5179, 100, 9)).toEqual({ first: 5170, end: 5179 })
  expect(nextPiece(0, 3, 0.5, 0)).toEqual({ first: 0, end: 1 })
})
