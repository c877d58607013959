import type { RecordingRow } from '../../api/schema'
import type { Item, Study } from './study'

/** A fingerprint by which a recording is recognised later or on another computer. */
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

/** Returns the recordings of a study that a database lacks, or that differ there: the trials would show something else than intended. */
export function strangersOf(study: Study, rows: readonly RecordingRow[]): readonly string[] {
  const by = new Map(rows.map((row) => [row.name, row]))
  return [...new Set(study.items.map(({ recording }) => recording))].toSorted().filter((name) => {
    const row = by.get(name),
      mark = study.recordings?.[name]
    return !row || (mark !== undefined && mark !== markOf(row))
  })
}
