import type { RecordingRow } from '../../api/answers'
import type { Item, Study } from './study'

/** By what a recording is known again on another day or another computer. */
const markOf = ({ frames, frames_per_second, joints }: RecordingRow) => `${frames} frames, ${frames_per_second} per second, ${joints} joints`

export function marksOf(items: readonly Item[], rows: readonly RecordingRow[]): Readonly<Record<string, string>> {
  const by = new Map(rows.map((row) => [row.name, row]))
  return Object.fromEntries(
    [...new Set(items.map(({ recording }) => recording))].toSorted().flatMap((name) => {
      const row = by.get(name)
      return row ? [[name, markOf(row)]] : []
    }),
  )
}

/** The recordings of a study that a database has not got, or that are others there: what would be shown is not what was meant. */
export function strangersOf(study: Study, rows: readonly RecordingRow[]): readonly string[] {
  const by = new Map(rows.map((row) => [row.name, row]))
  return [...new Set(study.items.map(({ recording }) => recording))].toSorted().filter((name) => {
    const row = by.get(name),
      mark = study.recordings?.[name]
    return !row || (mark !== undefined && mark !== markOf(row))
  })
}
