/** An element of an XML text, and where it stands: what is written into a text that stays as it is else. */
export interface Element {
  readonly name: string
  readonly attributes: Readonly<Record<string, string>>
  /** The whole element is text.slice(begin, end); its content text.slice(inner, innerEnd), the same place where it is written `<x/>`. */
  readonly begin: number
  readonly inner: number
  readonly innerEnd: number
  readonly end: number
  readonly children: readonly Element[]
}

const kName = /[^\s/>=]+/y,
  kSpace = /\s*/y

/**
 * The root element of a text, with all in it; none where tags do not match. Comments, CDATA and instructions are passed over; entities that a DOCTYPE makes
 * stay unread.
 */
export function parseXml(text: string): Element | undefined {
  interface Open {
    name: string
    attributes: Record<string, string>
    begin: number
    inner: number
    children: Element[]
  }
  const open: Open[] = []
  let root: Element | undefined
  for (let at = text.indexOf('<'); at >= 0; at = text.indexOf('<', at)) {
    const skipped = skip(text, at)
    if (skipped !== at) {
      if (skipped < 0) return undefined
      at = skipped
      continue
    }
    if (text[at + 1] === '/') {
      const close = text.indexOf('>', at),
        top = open.pop()
      if (close < 0 || !top || text.slice(at + 2, close).trim() !== top.name) return undefined
      const element: Element = { ...top, innerEnd: at, end: close + 1 }
      if (open.length > 0) open.at(-1)!.children.push(element)
      else root = element
      at = close + 1
      continue
    }
    const tag = startTag(text, at)
    if (!tag) return undefined
    const { name, attributes, end, empty } = tag
    if (!empty) open.push({ name, attributes, begin: at, inner: end, children: [] })
    else {
      const element: Element = { name, attributes, begin: at, inner: end, innerEnd: end, end, children: [] }
      if (open.length > 0) open.at(-1)!.children.push(element)
      else root = element
    }
    at = end
  }
  return open.length === 0 ? root : undefined
}

/** The place behind a comment, CDATA, instruction or DOCTYPE that begins here; this place where none does; −1 where it does not end. */
function skip(text: string, at: number): number {
  for (const [begin, end] of [
    ['<!--', '-->'],
    ['<![CDATA[', ']]>'],
    ['<?', '?>'],
  ]) {
    if (!text.startsWith(begin, at)) continue
    const close = text.indexOf(end, at + begin.length)
    return close < 0 ? -1 : close + end.length
  }
  if (!text.startsWith('<!', at)) return at
  let depth = 0
  for (let i = at + 2; i < text.length; ++i) {
    if (text[i] === '[') ++depth
    else if (text[i] === ']') --depth
    else if (text[i] === '>' && depth <= 0) return i + 1
  }
  return -1
}

function startTag(text: string, at: number): { name: string; attributes: Record<string, string>; end: number; empty: boolean } | undefined {
  const take = (pattern: RegExp, from: number) => {
    pattern.lastIndex = from
    return pattern.exec(text)?.[0] ?? ''
  }
  const name = take(kName, at + 1),
    attributes: Record<string, string> = {}
  if (!name) return undefined
  for (let i = at + 1 + name.length; ;) {
    i += take(kSpace, i).length
    if (text.startsWith('/>', i)) return { name, attributes, end: i + 2, empty: true }
    if (text[i] === '>') return { name, attributes, end: i + 1, empty: false }
    const attribute = take(kName, i)
    i += attribute.length
    i += take(kSpace, i).length
    if (!attribute || text[i] !== '=') return undefined
    i += 1 + take(kSpace, i + 1).length
    const close = text[i] === '"' || text[i] === "'" ? text.indexOf(text[i], i + 1) : -1
    if (close < 0) return undefined
    attributes[attribute] = unescaped(text.slice(i + 1, close))
    i = close + 1
  }
}

const kEntities: Readonly<Record<string, string>> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" }
export function unescaped(text: string): string {
  if (!text.includes('&')) return text
  return text.replace(/&(#x[\da-f]+|#\d+|\w+);/gi, (whole, name: string) => {
    if (name[0] !== '#') return kEntities[name] ?? whole
    const code = name[1] === 'x' || name[1] === 'X' ? parseInt(name.slice(2), 16) : Number(name.slice(1))
    return code <= 0x10ffff ? String.fromCodePoint(code) : whole
  })
}
export const escaped = (text: string) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;')

/** A place of a text, and what takes its place. */
export interface Edit {
  readonly begin: number
  readonly end: number
  readonly text: string
}
/** A text with edits that do not overlap; what is put in at one place stands in its order, before what is taken out there. */
export function edited(text: string, edits: readonly Edit[]): string {
  let result = '',
    at = 0
  for (const { begin, end, text: put } of [...edits].sort((a, b) => a.begin - b.begin || a.end - b.end)) {
    result += text.slice(at, begin) + put
    at = end
  }
  return result + text.slice(at)
}

/** The text of an XML file in whatever encoding it is, and the bytes of one: UTF-8, as it was where it was that. */
export function decoded(bytes: ArrayBuffer): string {
  const head = new Uint8Array(bytes.slice(0, 4))
  const [a, b, c, d] = head
  if ((a === 0xff && b === 0xfe) || (a === 0x3c && b === 0)) return new TextDecoder('utf-16le', { ignoreBOM: true }).decode(bytes)
  if ((a === 0xfe && b === 0xff) || (a === 0 && b === 0x3c && c === 0 && d !== 0)) return new TextDecoder('utf-16be', { ignoreBOM: true }).decode(bytes)
  const declared =
    /^\ufeff?<\?xml[^>]*\sencoding\s*=\s*["']([\w.-]+)["']/.exec(new TextDecoder('latin1').decode(bytes.slice(0, 200)).replace('ï»¿', ''))?.[1] ?? 'utf-8'
  try {
    return new TextDecoder(declared, { ignoreBOM: true }).decode(bytes)
  } catch {
    return new TextDecoder('utf-8', { ignoreBOM: true }).decode(bytes)
  }
}
export function encoded(text: string): Uint8Array<ArrayBuffer> {
  // It is UTF-8 from now on, and says so.
  return new TextEncoder().encode(text.replace(/^(\ufeff?<\?xml[^>]*\sencoding\s*=\s*["'])(?!utf-8["'])[\w.-]+/i, '$1UTF-8'))
}
