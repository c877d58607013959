/**
 * A table as RFC 4180 has it: fields that need it in quotes, lines ended by CR LF. Numbers are written as JSON writes them.
 * A text that a spreadsheet would take for a formula has an apostrophe before it, for people write into codes and comments what they like.
 */
export function csvOf(rows: readonly (readonly (string | number | null | undefined)[])[]): string {
  return rows.map((row) => row.map(fieldOf).join(',') + '\r\n').join('')
}
function fieldOf(field: string | number | null | undefined): string {
  const text = typeof field === 'string' && /^[=+\-@\t\r]/.test(field) ? `'${field}` : String(field ?? '')
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text
}
