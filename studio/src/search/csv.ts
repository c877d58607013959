/** Reads the server's CSV in chunks as it arrives: commas, quotes only if needed, lines that end in a line feed. */
export class CsvReader {
  private rest = ''

  /** Returns the records that are complete now. */
  push(text: string): string[][] {
    const all = this.rest + text
    // Most answers need no quotes, and then a line is a record.
    if (!all.includes('"')) {
      const end = all.lastIndexOf('\n') + 1
      this.rest = all.slice(end)
      return end === 0
        ? []
        : all
            .slice(0, end - 1)
            .split('\n')
            .map((line) => line.split(','))
    }
    return this.quoted(all)
  }

  private quoted(all: string): string[][] {
    const records: string[][] = []
    let record: string[] = [],
      begin = 0,
      at = 0
    while (at < all.length) {
      let field: string
      if (all[at] === '"') {
        let end = all.indexOf('"', at + 1)
        while (end >= 0 && all[end + 1] === '"') end = all.indexOf('"', end + 2)
        // The character after the quote must be available, because it may be another quote.
        if (end < 0 || end + 1 >= all.length) break
        field = all.slice(at + 1, end).replaceAll('""', '"')
        at = end + 1
      } else {
        let end = at
        while (end < all.length && all[end] !== ',' && all[end] !== '\n') ++end
        if (end >= all.length) break
        field = all.slice(at, end)
        at = end
      }
      record.push(field)
      if (all[at++] !== '\n') continue
      records.push(record)
      record = []
      begin = at
    }
    this.rest = all.slice(begin)
    return records
  }
}
