import { expect, it } from 'vitest'
import { along, axesOf, fitted, roundBelow } from './view'

const rounded = (values: readonly number[]) => values.map((value) => Number(value.toFixed(4)) + 0)
/** A body of a given height, starting at `from` above the floor. */
function body(height: number, from = 0) {
  const wide = height / 4
  return {
    least: [-wide, from, -wide] as const,
    most: [wide, from + height, wide] as const,
    cloud: Float32Array.of(-wide, from, 0, wide, from, 0, 0, from + height, 0),
  }
}

it("front view: the body's left is on the right of the picture", () => {
  for (const across of [undefined, [1, 0], [0, -1], [-0.6, 0.8]] as const) {
    const { x, y } = axesOf(across, 'front')
    const [ax, az] = across ?? [1, 0]
    expect(rounded([along(x, ax, 0, az), along(y, ax, 0, az)])).toEqual([1, 0])
    expect(rounded(y)).toEqual([0, 1, 0])
  }
})

it("side view: the body's front is on the left of the picture", () => {
  const { x } = axesOf([1, 0], 'side')
  expect(rounded(x)).toEqual([0, 0, -1])
})

it('angled view: closer points are lower', () => {
  const { y } = axesOf([1, 0], 'angle')
  expect(along(y, 0, 0, 1)).toBeLessThan(-0.1)
  expect(along(y, 0, 1, 0)).toBeGreaterThan(0.9)
})

it('fits a body of any size into the picture, with a mark of a round length', () => {
  const axes = axesOf([1, 0], 'front')
  for (const [height, mark] of [
    [1.7, 1],
    [170, 100],
    [0.017, 0.01],
  ]) {
    const fit = fitted(body(height), axes, 300, 240, 16)
    expect(fit.mark).toBe(mark)
    expect(fit.scale * height).toBeCloseTo(208, 3)
    expect(fit.y).toBeCloseTo(224, 3)
    expect(fit.y - fit.scale * height).toBeCloseTo(16, 3)
    expect(fit.floor).toEqual({ x: [-mark, mark], z: [-mark, mark] })
  }
})

it('shows the floor below a body, unless it is far away', () => {
  const axes = axesOf([1, 0], 'front')
  const above = fitted(body(1.7, 1), axes, 300, 240, 16)
  expect(above.floor).toBeDefined()
  expect(above.y).toBeCloseTo(224, 3)
  const far = fitted(body(1.7, 50), axes, 300, 240, 16)
  expect(far.floor).toBeUndefined()
  expect(far.scale * 1.7).toBeCloseTo(208, 3)
})

it('rounds down to a power of ten', () => {
  expect([0.0099, 0.01, 0.99, 1, 9.9, 10, 170].map(roundBelow)).toEqual([0.001, 0.01, 0.1, 1, 1, 10, 100])
})
