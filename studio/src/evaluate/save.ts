import { csvOf } from './csv'

/** Gives the user a file. */
export function save(name: string, type: string, content: string): void {
  const url = URL.createObjectURL(new Blob([content], { type }))
  const link = Object.assign(document.createElement('a'), { href: url, download: name })
  document.body.append(link)
  link.click()
  link.remove()
  setTimeout(() => URL.revokeObjectURL(url), 10_000)
}

/** Gives the user a table. The mark before it says that it is UTF-8: without it Excel spoils every accent. */
export function saveTable(name: string, rows: Parameters<typeof csvOf>[0]): void {
  save(`${name}.csv`, 'text/csv', '\ufeff' + csvOf(rows))
}

/** A name that every file system takes. */
export function plainName(text: string): string {
  return text.replace(/[^\p{L}\p{N}._-]+/gu, '_').replace(/^[._]+|_+$/g, '') || '_'
}
