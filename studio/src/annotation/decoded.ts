/** Returns the text of an XML file in any encoding, with its byte order mark: the server returns an annotation in the encoding of its file. */
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
