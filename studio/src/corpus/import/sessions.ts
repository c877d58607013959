import type { Api } from '../../api/client'
import { ImportSession } from './import_session.svelte'

const sessions = new Map<string, ImportSession>()
/** Returns the current import of a database, also after its page was left. */
export function sessionOf(api: Api, database: string): ImportSession {
  if (sessions.size === 0) addEventListener('pagehide', () => sessions.forEach((session) => session.close()))
  let session = sessions.get(database)
  if (!session) sessions.set(database, (session = new ImportSession(api, database)))
  return session
}
