import type { DatabaseRow } from '../../api/schema'
import { isPlaceholder } from '../../motion/declarations'

/** Reasons why dropped files are rejected. */
export type NotTaken = 'locked' | 'unknown' | 'noDatabase' | 'readOnly' | 'allReadOnly' | 'dialog' | 'busy'
/** The database into which dropped files are imported; or the reason why there is none, and the database concerned. */
export type DropTarget = { readonly database: string; readonly why?: undefined } | { readonly why: NotTaken; readonly database?: string }

/** Returns the database for the user's own files if none is chosen: preferably one without placeholder recordings. */
export function ownDatabase(databases: readonly DatabaseRow[]): DatabaseRow | undefined {
  const writable = databases.filter((one) => one.writable)
  return writable.find(({ declarations }) => !isPlaceholder(declarations)) ?? writable[0]
}

/** `databases` are those that are served, if known; `database` is that of the page, if it has one. */
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
