import { expect, it } from 'vitest'
import { keyOf, Pieces, type Piece } from './pieces'
import type { MotionSource, OpenedMotion } from './source'

const piece = (from: number): Piece => ({ recording: 'meteo', from, to: from + 1 })
const kSkeleton = { joints: [{ name: 'root', parent: -1, offset: [0, 0, 0] }], translated: [0], tracks: [] }

/** Pieces of 20 bytes a frame, ten frames each, that arrive on command. */
function rig(most?: number) {
  const asked: number[] = [],
    closed: number[] = []
  const ends = new Map<number, { come: () => Promise<void>; fail: () => Promise<void> }>()
  const settled = () => new Promise<void>((resolve) => setTimeout(resolve))
  const pieces = new Pieces(({ from }) => {
    asked.push(from)
    const source = {
      close: () => closed.push(from),
      open: () =>
        new Promise<OpenedMotion>((resolve, reject) =>
          ends.set(from, {
            come: () => (resolve({ store: { length: 10, skeleton: kSkeleton } } as unknown as OpenedMotion), settled()),
            fail: () => (reject(new Error('no')), settled()),
          }),
        ),
    }
    return source as unknown as MotionSource
  }, most)
  return { pieces, asked, closed, ends }
}

it('fetches a few at a time, in the requested order', async () => {
  const { pieces, asked, ends } = rig()
  const come: string[] = []
  pieces.onCome = (key) => come.push(key)
  pieces.want([3, 1, 2, 5, 4].map(piece))
  expect(asked).toEqual([3, 1, 2, 5])
  await ends.get(1)!.come()
  expect(asked).toEqual([3, 1, 2, 5, 4])
  expect(come).toEqual([keyOf(piece(1))])
  expect(pieces.get(piece(1))?.motion).toBeDefined()
  expect(pieces.get(piece(3))).toBeUndefined()
})

it('cancels pieces that are no longer wanted, and ignores their results', async () => {
  const { pieces, closed, ends } = rig()
  pieces.want([1, 2].map(piece))
  pieces.want([2].map(piece))
  expect(closed).toEqual([1])
  await ends.get(1)!.come()
  expect(pieces.get(piece(1))).toBeUndefined()
})

it('caches pieces up to a number of bytes, and never drops a wanted one', async () => {
  const { pieces, asked, ends } = rig(450)
  for (const from of [1, 2, 3]) {
    pieces.want([piece(from)])
    await ends.get(from)!.come()
  }
  expect([1, 2, 3].map((from) => pieces.get(piece(from)) !== undefined)).toEqual([false, true, true])
  pieces.want([2, 3, 1].map(piece))
  await ends.get(1)!.come()
  expect([1, 2, 3].map((from) => pieces.get(piece(from)) !== undefined)).toEqual([true, true, true])
  expect(asked).toEqual([1, 2, 3, 1])
})

it('reports a fault, and retries on request or when wanted again', async () => {
  const { pieces, asked, ends } = rig()
  pieces.want([piece(1)])
  await ends.get(1)!.fail()
  expect(pieces.get(piece(1))?.fault).toBeInstanceOf(Error)
  pieces.want([piece(1)])
  expect(asked).toEqual([1])
  pieces.retry(piece(1))
  expect(asked).toEqual([1, 1])
  await ends.get(1)!.fail()
  pieces.want([])
  pieces.want([piece(1)])
  expect(asked).toEqual([1, 1, 1])
})
