/** Sets French text: a narrow no-break space (U+202F) before ; : ! ? » and %, and after «. For lists and tables, sets every text in them. */
export function typeset<T>(text: T): T {
  if (typeof text === 'string') return text.replace(/ (?=[;:!?»%](?:$|[\s.,)…»\u202f]))/g, '\u202f').replace(/« /g, '«\u202f') as T
  if (Array.isArray(text)) return text.map((one: unknown) => typeset(one)) as T
  if (text === null || typeof text !== 'object') return text
  return Object.fromEntries(Object.entries(text).map(([name, value]) => [name, typeset(value as unknown)])) as T
}
