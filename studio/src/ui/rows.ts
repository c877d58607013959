/** Browsers let no element be higher than some 17 to 33 million pixels; rows beyond are reached by a scale between bar and list. */
export const kMostPixels = 8_000_000

/** Which rows of a long list are drawn, and where, for a place of the scroll bar. */
export interface ShownRows {
  readonly first: number
  readonly end: number
  /** Pixels from the top of all to the first that is drawn. */ readonly top: number
}

/** Pixels that a list of `count` rows takes at most. */
export function heightOfRows(count: number, rowHeight: number): number {
  return Math.min(count * rowHeight, kMostPixels)
}

/** `scroll` and `height` are those of the window onto the list; `spare` rows are drawn on each side of it. */
export function shownRows(count: number, rowHeight: number, scroll: number, height: number, spare = 6): ShownRows {
  const whole = count * rowHeight,
    shown = heightOfRows(count, rowHeight)
  const most = Math.max(0, shown - height)
  const at = most > 0 ? (Math.min(scroll, most) / most) * Math.max(0, whole - height) : 0
  const first = Math.max(0, Math.floor(at / rowHeight) - spare)
  const end = Math.min(count, Math.ceil((at + height) / rowHeight) + spare)
  return { first, end, top: Math.min(scroll, most) - at + first * rowHeight }
}

/** The place of the scroll bar at which a row is whole in the window; the one that is, where it is so already. */
export function scrollTo(row: number, count: number, rowHeight: number, scroll: number, height: number): number {
  const whole = count * rowHeight,
    shown = heightOfRows(count, rowHeight)
  const most = Math.max(0, shown - height),
    far = Math.max(0, whole - height)
  const at = most > 0 ? (Math.min(scroll, most) / most) * far : 0
  const wanted = Math.min(row * rowHeight, Math.max(at, (row + 1) * rowHeight - height))
  return far > 0 && wanted !== at ? (wanted / far) * most : scroll
}
