/** A table as RFC 4180 has it: fields that need it in quotes, lines ended by CR LF. Numbers are written as JSON writes them. */
export function csvOf(rows: readonly (readonly (string | number | null | undefined)[])[]): string {
  return rows.map((row) => row.map(fieldOf).join(',') + '\r\n').join('')
}
function fieldOf(field: string | number | null | undefined): string {
  const text = field === null || field === undefined ? '' : String(field)
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text
}
