import type { Answer, Match } from './answers'

/** The sort keys of answers; `found` is the server's own order. */
export type SortKey = 'found' | 'recording' | 'tier' | 'name' | 'begin' | 'end' | 'duration' | 'distance' | 'match' | `$${number}`
export interface Order {
  readonly by: SortKey
  readonly down: boolean
}
export const kFound: Order = { by: 'found', down: false }

/** Returns the order after a click on a column's header: ascending, then descending, then as found. */
export function nextOrder(order: Order, by: SortKey): Order {
  if (order.by !== by) return { by, down: false }
  return order.down ? kFound : { by, down: true }
}

/** Returns an order as written in the address: `name`, `-duration`. */
export function orderText({ by, down }: Order): string {
  return down ? `-${by}` : by
}
export function orderOf(text: string | undefined): Order {
  const [, minus, by] = /^(-?)(recording|tier|name|begin|end|duration|distance|match|\$\d+)$/.exec(text ?? '') ?? []
  return by ? { by: by as SortKey, down: minus === '-' } : kFound
}

/** Returns the answers whose name, recording or tier contains the typed text; case is ignored. */
export function filtered(answers: readonly Answer[], wanted: string): readonly Answer[] {
  const words = wanted.toLowerCase().split(/\s+/).filter(Boolean)
  if (words.length === 0) return answers
  return answers.filter(({ name, recording, tier }) => {
    const text = `${name} ${recording} ${tier}`.toLowerCase()
    return words.every((word) => text.includes(word))
  })
}

/** Sorts the answers; equal ones stay in the order found. */
export function ordered(answers: readonly Answer[], { by, down }: Order, language: string): readonly Answer[] {
  if (by === 'found') return answers
  const value = textOf(by) ? rankOf(answers, textOf(by)!, language) : numberOf(by)
  const keys = Float64Array.from(answers, value)
  const places = Uint32Array.from(answers, (_, i) => i)
  places.sort((a, b) => (down ? keys[b] - keys[a] : keys[a] - keys[b]) || a - b)
  return Array.from(places, (i) => answers[i])
}

const kMatches: readonly (Match | undefined)[] = ['exact', 'folded', 'sequence', 'part', 'label', 'some']

function numberOf(by: SortKey): (answer: Answer) => number {
  if (by === 'begin') return ({ begin }) => begin
  if (by === 'end') return ({ end }) => end
  if (by === 'duration') return ({ begin, end }) => end - begin
  if (by === 'match') return ({ match }) => kMatches.indexOf(match)
  return ({ distance }) => distance ?? Infinity
}

function textOf(by: SortKey): ((answer: Answer) => string) | undefined {
  if (by === 'recording') return ({ recording }) => recording
  if (by === 'tier') return ({ tier }) => tier
  if (by === 'name') return ({ name }) => name
  if (by.startsWith('$')) return ({ bindings }) => bindings?.[Number(by.slice(1))] ?? ''
  return undefined
}

/**
 * Returns the rank of each text. Locale-aware comparison is slow, and sequence names are many but consist of few words: so each word is compared once, and
 * texts then by the ranks of their words.
 */
function rankOf(answers: readonly Answer[], text: (answer: Answer) => string, language: string): (answer: Answer) => number {
  const texts = [...new Set(answers.map(text))],
    words = texts.map((one) => one.split(' '))
  const { compare } = new Intl.Collator(language, { numeric: true })
  const numbers = new Map([...new Set(words.flat())].sort(compare).map((word, n) => [word, String.fromCharCode(1 + (n >> 15), n & 0x7fff)]))
  const keys = words.map((list) => list.map((word) => numbers.get(word)).join(''))
  const places = keys.map((_, i) => i).sort((a, b) => (keys[a] < keys[b] ? -1 : keys[a] > keys[b] ? 1 : 0))
  const ranks = new Map<string, number>()
  places.forEach((i, rank) => ranks.set(texts[i], rank))
  return (answer) => ranks.get(text(answer))!
}
