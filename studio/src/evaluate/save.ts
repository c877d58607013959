import { csvOf } from './csv'

/** Saves a file for the user. */
export function save(name: string, type: string, content: string): void {
  const url = URL.createObjectURL(new Blob([content], { type }))
  const link = Object.assign(document.createElement('a'), { href: url, download: name })
  document.body.append(link)
  link.click()
  link.remove()
  setTimeout(() => URL.revokeObjectURL(url), 10_000)
}

/** Saves a table for the user. The byte order mark identifies it as UTF-8: without it, Excel garbles every accent. */
export function saveTable(name: string, rows: Parameters<typeof csvOf>[0]): void {
  save(`${name}.csv`, 'text/csv', '\ufeff' + csvOf(rows))
}

/** Returns a name that is valid in every file system. */
export function plainName(text: string): string {
  return text.replace(/[^\p{L}\p{N}._-]+/gu, '_').replace(/^[._]+|_+$/g, '') || '_'
}
