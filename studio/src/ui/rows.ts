/** Browsers limit the height of an element to about 17 to 33 million pixels; for longer lists the scroll position is scaled. */
export const kMostPixels = 8_000_000

/** The rows of a long list that are drawn for a scroll position, and their position. */
export interface ShownRows {
  readonly first: number
  readonly end: number
  /** Pixels from the top of the list to the first row drawn. */ readonly top: number
}

/** Returns the height of a list of `count` rows in pixels, up to the limit. */
export function heightOfRows(count: number, rowHeight: number): number {
  return Math.min(count * rowHeight, kMostPixels)
}

/** `scroll` and `height` are those of the visible area; `spare` rows are drawn on each side of it. */
export function shownRows(count: number, rowHeight: number, scroll: number, height: number, spare = 6): ShownRows {
  const whole = count * rowHeight,
    shown = heightOfRows(count, rowHeight)
  const most = Math.max(0, shown - height)
  const at = most > 0 ? (Math.min(scroll, most) / most) * Math.max(0, whole - height) : 0
  const first = Math.max(0, Math.floor(at / rowHeight) - spare)
  const end = Math.min(count, Math.ceil((at + height) / rowHeight) + spare)
  return { first, end, top: Math.min(scroll, most) - at + first * rowHeight }
}

/** Returns the scroll position at which a row is completely visible; the current one if it already is. */
export function scrollTo(row: number, count: number, rowHeight: number, scroll: number, height: number): number {
  const whole = count * rowHeight,
    shown = heightOfRows(count, rowHeight)
  const most = Math.max(0, shown - height),
    far = Math.max(0, whole - height)
  const at = most > 0 ? (Math.min(scroll, most) / most) * far : 0
  const wanted = Math.min(row * rowHeight, Math.max(at, (row + 1) * rowHeight - height))
  return far > 0 && wanted !== at ? (wanted / far) * most : scroll
}
