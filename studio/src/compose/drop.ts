/** The position of a card on the screen. */
export interface Box {
  readonly left: number
  readonly right: number
  readonly top: number
  readonly bottom: number
}

/**
 * Returns the index of the card before which something dropped at a point is inserted: cards are in lines, read from the left; the number of cards means the
 * end.
 */
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
/** Returns how many px a list scrolls while something is dragged near or beyond its upper or lower border. */
export function scrollAt({ top, bottom }: Pick<Box, 'top' | 'bottom'>, y: number): number {
  return y < top + kEdge ? -kEdge : y > bottom - kEdge ? kEdge : 0
}
