import type { RecordingRow } from '../../api/schema'

export type SortBy = 'name' | 'signer' | 'seconds' | 'frames' | 'rate' | 'tracks' | 'defects' | 'storage'
export interface ListOptions {
  readonly text: string
  /** Undefined: all signers. */ readonly signer?: string
  readonly sort: SortBy
  readonly descending: boolean
}

export const secondsOf = ({ frames, frames_per_second: rate }: RecordingRow): number | undefined => (frames !== undefined && rate ? frames / rate : undefined)

const kValues: Readonly<Record<SortBy, (row: RecordingRow) => string | number | undefined>> = {
  name: ({ name }) => name,
  signer: ({ signer }) => signer,
  seconds: secondsOf,
  frames: ({ frames }) => frames,
  rate: (row) => row.frames_per_second,
  tracks: ({ tracks }) => tracks?.length,
  defects: ({ defects }) => defects,
  storage: (row) => row.access_mode,
}
const collator = new Intl.Collator(undefined, { numeric: true })

/** Returns the matching rows in the requested order; rows without a value come last, and equal rows are ordered by name. */
export function rowsOf(rows: readonly RecordingRow[], { text, signer, sort, descending }: ListOptions): readonly RecordingRow[] {
  const wanted = text.trim().toLowerCase(),
    value = kValues[sort],
    sign = descending ? -1 : 1
  const found = rows.filter((row) => (signer === undefined || row.signer === signer) && row.name.toLowerCase().includes(wanted))
  return found.sort((a, b) => {
    const x = value(a),
      y = value(b)
    if (x === undefined || y === undefined) return (x === undefined ? 1 : 0) - (y === undefined ? 1 : 0) || collator.compare(a.name, b.name)
    const order = typeof x === 'string' ? collator.compare(x, y as string) : x - (y as number)
    return sign * order || collator.compare(a.name, b.name)
  })
}

/** Returns the signers, in alphabetical order. */
export const signersOf = (rows: readonly RecordingRow[]): readonly string[] => [...new Set(rows.map(({ signer }) => signer))].sort(collator.compare)
