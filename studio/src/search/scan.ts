import type { FaultPlace } from '../api/fault'

/** One token of a query, as defined in docs/query.md; an unfinished one counts, too. */
export interface Token {
  readonly kind: 'word' | 'text' | 'regex' | 'variable' | 'symbol' | /** `[..500ms]` */ 'gap'
  readonly begin: number
  readonly end: number
  /** For a text: the content of the quotes, with escapes resolved. */
  readonly text: string
  /** Whether a text, regex or gap is closed. */
  readonly closed: boolean
}

const kSymbols = ['->', '!=', '=~', '<=', '>=', '(', ')', '&', '|', '!', '@', ',', '=', '<', '>', '~', ';', ']']
const kEndsWord = /[\s"()[\]&|!=<>~/@,;]|->/y

/** Splits a query into tokens. Never throws, because completion runs on unfinished queries. */
export function scan(text: string): Token[] {
  const tokens: Token[] = []
  let at = 0
  while (at < text.length) {
    if (/\s/.test(text[at])) {
      ++at
      continue
    }
    const token = tokenFrom(text, at, tokens[tokens.length - 1])
    tokens.push(token)
    at = token.end
  }
  return tokens
}

function tokenFrom(text: string, begin: number, before: Token | undefined): Token {
  const first = text[begin]
  if (first === '"') return enclosed('text', text, begin, '"')
  // A slash directly after a word belongs to a unit: 1.5 m/s.
  if (first === '/' && !(before?.kind === 'word' && before.end === begin)) return enclosed('regex', text, begin, '/')
  if (first === '[') return enclosed('gap', text, begin, ']')
  const symbol = kSymbols.find((one) => text.startsWith(one, begin))
  if (symbol) return { kind: 'symbol', begin, end: begin + symbol.length, text: symbol, closed: true }
  let end = begin + 1
  for (; end < text.length; ++end) {
    kEndsWord.lastIndex = end
    if (kEndsWord.test(text)) break
  }
  return { kind: first === '$' ? 'variable' : 'word', begin, end, text: text.slice(begin, end), closed: true }
}

function enclosed(kind: 'text' | 'regex' | 'gap', text: string, begin: number, last: string): Token {
  let value = '',
    at = begin + 1
  for (; at < text.length && text[at] !== last; ++at) {
    if (text[at] === '\\' && kind !== 'gap' && at + 1 < text.length) {
      const escaped = text[++at]
      value +=
        kind === 'regex' && escaped !== '/' ? `\\${escaped}` : kind === 'text' && escaped === 'n' ? '\n' : kind === 'text' && escaped === 't' ? '\t' : escaped
    } else value += text[at]
  }
  const closed = at < text.length
  let end = closed ? at + 1 : text.length
  if (kind === 'regex' && closed) while (end < text.length && /[a-z]/i.test(text[end])) ++end
  return { kind, begin, end, text: value, closed }
}

/** Converts the server's position to an offset in a JavaScript string. */
export function offsetOf(text: string, { line, column }: FaultPlace): number {
  const lines = text.split('\n')
  const before = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0)
  const letters = [...(lines[line - 1] ?? '')].slice(0, column - 1)
  return Math.min(text.length, before + letters.join('').length)
}

/** Returns the range marked for a fault: the token there, otherwise one letter; empty at the end. */
export function markAt(text: string, offset: number): { readonly begin: number; readonly end: number } {
  const token = scan(text).find(({ begin, end }) => begin <= offset && offset < end)
  if (token && token.begin === offset) return { begin: offset, end: token.closed ? token.end : token.begin + 1 }
  return { begin: offset, end: Math.min(text.length, offset + 1) }
}
