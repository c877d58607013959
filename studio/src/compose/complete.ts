/** A gloss that can be signed. */
export interface GlossEntry {
  readonly gloss: string
  readonly tokens: number
  readonly folded: string
}
/** The glosses of a database, prepared for completion. */
export interface Glosses {
  /** Ordered by their folded forms. */
  readonly entries: readonly GlossEntry[]
  /** Keys folded as the server compares them; values are numbers of tokens. */
  readonly known: ReadonlyMap<string, number>
}

/** Removes accents and case, so that typed text finds glosses that differ only in these. */
export function folded(text: string): string {
  return text
    .normalize('NFD')
    .replace(/\p{M}+/gu, '')
    .toLowerCase()
}
const matched = (gloss: string) => gloss.normalize('NFC').trim()

export function glossesOf(rows: readonly { readonly gloss: string; readonly tokens: number }[]): Glosses {
  const entries = rows.map(({ gloss, tokens }) => ({ gloss, tokens, folded: folded(gloss) }))
  entries.sort((a, b) => (a.folded < b.folded ? -1 : a.folded > b.folded ? 1 : a.gloss < b.gloss ? -1 : 1))
  return { entries, known: new Map(rows.map(({ gloss, tokens }) => [matched(gloss), tokens])) }
}

/** Returns the number of tokens of a gloss; undefined if the database does not know it. */
export function tokensOf(glosses: Glosses, gloss: string): number | undefined {
  return glosses.known.get(matched(gloss))
}

/** Returns the glosses that begin with the typed text, then those that contain it, each in alphabetical order; the first glosses if nothing is typed. */
export function completions({ entries }: Glosses, typed: string, most = 50): GlossEntry[] {
  const wanted = folded(typed.trim())
  let low = 0,
    high = entries.length
  while (low < high) {
    const middle = (low + high) >> 1
    if (entries[middle].folded < wanted) low = middle + 1
    else high = middle
  }
  const found: GlossEntry[] = []
  let at = low
  for (; at < entries.length && found.length < most && entries[at].folded.startsWith(wanted); ++at) found.push(entries[at])
  if (found.length === most || wanted === '') return found
  for (const entry of entries) {
    if (found.length === most) break
    if (entry.folded.includes(wanted, 1) && !entry.folded.startsWith(wanted)) found.push(entry)
  }
  return found
}

/** The word being typed at the caret: its range, and its text so far without quotes. */
export interface TypedWord {
  readonly from: number
  readonly to: number
  readonly typed: string
}

export function wordAt(text: string, caret: number): TypedWord {
  let from = 0,
    open = false
  for (let i = 0; i < caret; ++i) {
    if (text[i] === '"' && (open || i === from)) open = !open
    else if (!open && /\s/.test(text[i])) from = i + 1
  }
  let to = caret
  while (to < text.length && (open ? text[to] !== '"' : !/\s/.test(text[to]))) ++to
  if (open && to < text.length) ++to
  return {
    from,
    to,
    typed: text
      .slice(from, caret)
      .replaceAll('"', '')
      .replace(/(?<=.)[#@][\d.]*$/, ''),
  }
}

/** Whether a bracket or a brace is open before the caret: what it holds is not finished. */
export function isInBrackets(text: string, caret: number): boolean {
  const before = text.slice(0, caret).replace(/"[^"]*("|$)/g, '')
  return before.split(/[[{]/).length > before.split(/[\]}]/).length
}
