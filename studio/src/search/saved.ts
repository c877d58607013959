/** A query saved under a name. */
export interface SavedQuery {
  readonly name: string
  readonly text: string
}
export interface Kept {
  readonly saved: readonly SavedQuery[]
  /** Recent queries, newest first. */
  readonly recent: readonly string[]
}
export const kNothingKept: Kept = { saved: [], recent: [] }
const kRecent = 20
/** The key of a file of queries, and its format version. */
const kFile = 'signweave queries'

/** Reads the stored state; unreadable parts are ignored. */
export function readKept(stored: string | null | undefined): Kept {
  try {
    const { saved, recent } = JSON.parse(stored ?? '') as Partial<Kept>
    return {
      saved: Array.isArray(saved) ? saved.filter(isQuery).map(plain) : [],
      recent: Array.isArray(recent) ? recent.filter((one) => typeof one === 'string').slice(0, kRecent) : [],
    }
  } catch {
    return kNothingKept
  }
}

/** Saves a query under a name, replacing any previous one. */
export function keep(kept: Kept, name: string, text: string): Kept {
  const at = kept.saved.findIndex((one) => one.name === name)
  return { ...kept, saved: at < 0 ? [...kept.saved, { name, text }] : kept.saved.with(at, { name, text }) }
}

/** Renames a query to a free name; unchanged if the name is empty. */
export function rename(kept: Kept, from: string, to: string): Kept {
  const at = kept.saved.findIndex(({ name }) => name === from)
  const wanted = to.trim()
  if (at < 0 || !wanted || wanted === from) return kept
  return { ...kept, saved: kept.saved.with(at, { ...kept.saved[at], name: freeName(kept.saved, wanted) }) }
}

export function remove(kept: Kept, name: string): Kept {
  return { ...kept, saved: kept.saved.filter((one) => one.name !== name) }
}

/** Restores a removed query at its position; a replaced one takes its name again. */
export function restore(kept: Kept, query: SavedQuery, at: number, replaced = false): Kept {
  if (replaced && kept.saved.some(({ name }) => name === query.name)) return keep(kept, query.name, query.text)
  return { ...kept, saved: kept.saved.toSpliced(at, 0, { ...query, name: freeName(kept.saved, query.name) }) }
}

/** Moves a query to the front of the recent ones, without duplicates. */
export function asked(kept: Kept, text: string): Kept {
  const one = text.trim()
  return one ? { ...kept, recent: [one, ...kept.recent.filter((other) => other !== one)].slice(0, kRecent) } : kept
}

/** Adds queries of a file. Existing ones are not added again; a different query with the same name gets a number. */
export function merged(kept: Kept, more: readonly SavedQuery[]): Kept {
  let saved = kept.saved
  for (const query of more) {
    if (saved.some(({ name, text }) => name === query.name && text === query.text)) continue
    saved = [...saved, { ...query, name: freeName(saved, query.name) }]
  }
  return { ...kept, saved }
}

export function writeFile(saved: readonly SavedQuery[]): string {
  return JSON.stringify({ [kFile]: 1, queries: saved }, null, 2) + '\n'
}

/** Reads the queries of a file; undefined if it is no such file. */
export function readFile(text: string): readonly SavedQuery[] | undefined {
  try {
    const file = JSON.parse(text) as Record<string, unknown>
    return kFile in file && Array.isArray(file.queries) && file.queries.every(isQuery) ? file.queries.map(plain) : undefined
  } catch {
    return undefined
  }
}

function freeName(saved: readonly SavedQuery[], wanted: string): string {
  let name = wanted
  for (let n = 2; saved.some((one) => one.name === name); ++n) name = `${wanted} (${n})`
  return name
}
function isQuery(one: unknown): one is SavedQuery {
  const { name, text } = (one ?? {}) as Partial<SavedQuery>
  return typeof name === 'string' && name.trim() !== '' && typeof text === 'string' && text.trim() !== ''
}
const plain = ({ name, text }: SavedQuery): SavedQuery => ({ name: name.trim(), text })
