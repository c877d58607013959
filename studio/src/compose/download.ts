/** Saves something as a file through the browser. */
export function download(what: Blob | string, name: string, type = 'application/json'): void {
  const blob = typeof what === 'string' ? new Blob([what], { type }) : what
  const url = URL.createObjectURL(blob)
  const link = document.createElement('a')
  link.href = url
  link.download = name
  link.click()
  // The browser reads the bytes some time after the click.
  setTimeout(() => URL.revokeObjectURL(url), 60_000)
}

/** Turns a text into a file name: without characters that file systems forbid, and not too long. */
export function fileName(title: string, extension: string): string {
  const plain = title
    .normalize('NFC')
    .replace(/["#@.,…<>:/\\|?*\p{Cc}]+/gu, ' ')
    .trim()
    .replace(/\s+/g, '_')
    .slice(0, 60)
  return `${plain || 'signweave'}${extension}`
}
