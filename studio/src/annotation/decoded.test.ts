import { expect, it } from 'vitest'
import { decoded } from './decoded'

it('reads any encoding', () => {
  const text = '<?xml version="1.0" encoding="ISO-8859-1"?><a b="é"/>'
  expect(decoded(new Uint8Array([...text].map((c) => c.charCodeAt(0))).buffer)).toBe(text)
  const wide = new Uint8Array(2 * text.length)
  ;[...text].forEach((c, i) => (wide[2 * i] = c.charCodeAt(0)))
  expect(decoded(wide.buffer)).toBe(text)
  const marked = '\ufeff<?xml version="1.0" encoding="utf-8"?><a/>'
  expect(decoded(new TextEncoder().encode(marked).buffer)).toBe(marked)
})
