import { shownRows } from '../ui/rows'

/** The layout of cells in a window: as many columns as fit, widened to fill the width. */
export interface CellGrid {
  readonly columns: number
  readonly width: number
  /** The width of the picture. */ readonly picture: number
  /** From one row of cells to the next. */ readonly step: number
}
export const kGap = 8
export const kCaption = 48
export const kSizes = { small: 132, medium: 184, large: 268 } as const
export type Size = keyof typeof kSizes

export function layoutOf(width: number, size: Size): CellGrid {
  // Two columns on a phone, unless the size is large.
  const wanted = size === 'large' ? kSizes.large : Math.min(kSizes[size], Math.max(kSizes.small, (width - kGap) / 2))
  const columns = Math.max(1, Math.floor((width + kGap) / (wanted + kGap)))
  const each = Math.max(40, Math.floor((width - kGap * (columns - 1)) / columns))
  const picture = Math.round(Math.min(each, 1.5 * kSizes[size]) * 0.96)
  return { columns, width: each, picture, step: picture + kCaption + kGap }
}

/** Returns the cells to create for a scroll position, and the position of their first row. */
export function shownCells(count: number, { columns, step }: CellGrid, scroll: number, height: number, spare = 1) {
  const { first, end, top } = shownRows(Math.ceil(count / columns), step, scroll, height, spare)
  return { first: first * columns, end: Math.min(count, end * columns), row: first, top }
}

/** Returns the cell that a key moves to; the same one for other keys. */
export function moved(key: string, at: number, count: number, columns: number, rowsInView: number): number {
  const page = columns * Math.max(1, rowsInView)
  const to: Readonly<Record<string, number>> = {
    ArrowLeft: at - 1,
    ArrowRight: at + 1,
    ArrowUp: at - columns < 0 ? at : at - columns,
    ArrowDown: at + columns >= count ? at : at + columns,
    Home: 0,
    End: count - 1,
    PageUp: at - page,
    PageDown: at + page,
  }
  return Math.min(count - 1, Math.max(0, to[key] ?? at))
}
