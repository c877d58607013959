import type { DatabaseRow } from '../../api/answers'
import { isPlaceholder } from '../../motion/declarations'

/** Why files that are dropped are not taken. */
export type NotTaken = 'locked' | 'unknown' | 'noDatabase' | 'readOnly' | 'allReadOnly' | 'dialog' | 'busy'
/** The database that dropped files are imported into; or why there is none, and which one is meant. */
export type DropTarget = { readonly database: string; readonly why?: undefined } | { readonly why: NotTaken; readonly database?: string }

/** Where somebody's own files belong where no database is chosen: not beside placeholders, if that can be helped. */
export function ownDatabase(databases: readonly DatabaseRow[]): DatabaseRow | undefined {
  const writable = databases.filter((one) => one.writable)
  return writable.find(({ declarations }) => !isPlaceholder(declarations)) ?? writable[0]
}

/** `databases` are those that are served, where that is known; `database` is the one that the page is about, if it is about one. */
export function dropTarget(locked: boolean, databases: readonly DatabaseRow[] | undefined, database: string | undefined): DropTarget {
  if (locked) return { why: 'locked' }
  if (!databases) return { why: 'unknown' }
  if (databases.length === 0) return { why: 'noDatabase' }
  if (database === undefined) {
    const own = ownDatabase(databases)
    return own ? { database: own.name } : { why: 'allReadOnly' }
  }
  const row = databases.find(({ name }) => name === database)
  if (!row) return { why: 'noDatabase' }
  return row.writable ? { database } : { why: 'readOnly', database }
}
