/** Where a card is on the screen. */
export interface Box {
  readonly left: number
  readonly right: number
  readonly top: number
  readonly bottom: number
}

/** Before which card something falls that is let go at a point: cards stand in lines, read from the left; their number means the end. */
export function dropAt(boxes: readonly Box[], x: number, y: number): number {
  let at = 0
  for (const { left, right, top, bottom } of boxes) {
    const above = bottom < y,
      same = top <= y && y <= bottom
    if (!above && !(same && (left + right) / 2 < x)) break
    ++at
  }
  return at
}

const kEdge = 10
/** How many px a list of lines moves on while something is dragged to a point near its upper or lower border, or beyond. */
export function scrollAt({ top, bottom }: Pick<Box, 'top' | 'bottom'>, y: number): number {
  return y < top + kEdge ? -kEdge : y > bottom - kEdge ? kEdge : 0
}
