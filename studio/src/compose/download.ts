/** Lets the browser save something as a file. */
export function download(what: Blob | string, name: string, type = 'application/json'): void {
  const blob = typeof what === 'string' ? new Blob([what], { type }) : what
  const url = URL.createObjectURL(blob)
  const link = document.createElement('a')
  link.href = url
  link.download = name
  link.click()
  // The browser takes the bytes up later than the click.
  setTimeout(() => URL.revokeObjectURL(url), 60_000)
}

/** A text as the name of a file: without what systems forbid, not too long. */
export function fileName(title: string, ending: string): string {
  const plain = title
    .normalize('NFC')
    .replace(/["#@.,…<>:/\\|?*\p{Cc}]+/gu, ' ')
    .trim()
    .replace(/\s+/g, '_')
    .slice(0, 60)
  return `${plain || 'signweave'}${ending}`
}
