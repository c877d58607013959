import { quoted } from './answers'
import { markAt, offsetOf, scan } from './scan'
import { suggested, type FaultPlace } from '../api/fault'

/** A corrected query suggested by the server's message, if it is clear what to replace. */
export interface Replacement {
  readonly label: string
  readonly text: string
}

/** Returns the corrections that a fault or hint of the server suggests for a query. `place` is the server's position. */
export function replacements(text: string, message: string, place?: FaultPlace): Replacement[] {
  const names = suggested(message)
  if (names.length === 0) return []
  if (place) {
    const { begin, end } = markAt(text, offsetOf(text, place))
    return names.map((name) => ({ label: name, text: text.slice(0, begin) + (text[begin] === '"' ? quoted(name) : name) + text.slice(end) }))
  }
  // For plain words, the suggestion may be a query.
  if (names.length === 1 && / = /.test(names[0])) return [{ label: names[0], text: names[0] }]
  const wrong = wrongIn(message)
  const token = wrong === undefined ? undefined : scan(text).find(({ kind, text: value }) => (kind === 'text' || kind === 'word') && value.trim() === wrong)
  if (!token) return []
  return names.map((name) => ({ label: name, text: text.slice(0, token.begin) + quoted(name) + text.slice(token.end) }))
}

/** Returns the unknown name: the last one in quotes before the suggestion. */
function wrongIn(message: string): string | undefined {
  const before = message.slice(0, message.indexOf('did you mean'))
  return [...before.matchAll(/"([^"]*)"|'([^']*)'/g)].map(([, a, b]) => a ?? b).pop()
}

/** Removes the position from the server's message, because the screen shows it in the user's language. */
export function withoutPlace(message: string): string {
  return message.replace(/^query:\d+:\d+: /, '')
}
