import { quoted } from './answers'
import { markAt, offsetOf, scan } from './scan'
import { suggested, type FaultPlace } from '../api/fault'

/** Another text of the query that the server's words suggest, where it is plain what to replace by what. */
export interface Replacement {
  readonly label: string
  readonly text: string
}

/** What a fault or hint of the server suggests for a query. `place` is where the server put its caret. */
export function replacements(text: string, message: string, place?: FaultPlace): Replacement[] {
  const names = suggested(message)
  if (names.length === 0) return []
  if (place) {
    const { begin, end } = markAt(text, offsetOf(text, place))
    return names.map((name) => ({ label: name, text: text.slice(0, begin) + (text[begin] === '"' ? quoted(name) : name) + text.slice(end) }))
  }
  // Words alone: what is suggested for them may be a query.
  if (names.length === 1 && / = /.test(names[0])) return [{ label: names[0], text: names[0] }]
  const wrong = wrongIn(message)
  const token = wrong === undefined ? undefined : scan(text).find(({ kind, text: value }) => (kind === 'text' || kind === 'word') && value.trim() === wrong)
  if (!token) return []
  return names.map((name) => ({ label: name, text: text.slice(0, token.begin) + quoted(name) + text.slice(token.end) }))
}

/** The name that is not known: the last that stands in quotes before the suggestion. */
function wrongIn(message: string): string | undefined {
  const before = message.slice(0, message.indexOf('did you mean'))
  return [...before.matchAll(/"([^"]*)"|'([^']*)'/g)].map(([, a, b]) => a ?? b).pop()
}

/** The server's line without the place before it, which the screen tells in the user's language. */
export function withoutPlace(message: string): string {
  return message.replace(/^query:\d+:\d+: /, '')
}
