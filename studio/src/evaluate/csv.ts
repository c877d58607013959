/**
 * Writes a table per RFC 4180: fields are quoted if necessary, lines end with CR LF. Numbers are written as in JSON. A text that a spreadsheet would interpret
 * as a formula gets a leading apostrophe, because codes and comments are free text.
 */
export function csvOf(rows: readonly (readonly (string | number | null | undefined)[])[]): string {
  return rows.map((row) => row.map(fieldOf).join(',') + '\r\n').join('')
}
function fieldOf(field: string | number | null | undefined): string {
  const text = typeof field === 'string' && /^[=+\-@\t\r]/.test(field) ? `'${field}` : String(field ?? '')
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text
}
