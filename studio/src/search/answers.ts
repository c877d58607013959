/** A segment that a query found. Times are ms of annotation time. */
export interface Answer {
  /** Its index in the server's answer, from 0. */
  readonly at: number
  readonly recording: string
  readonly tier: string
  readonly name: string
  readonly begin: number
  readonly end: number
  /** For an answer to `like(…)`: 0 is the same movement. */
  readonly distance?: number
  /** How it matches the words searched for (docs/query.md). */
  readonly match?: Match
  /** The values of the query's variables, in the order of `AnswerReader.variables`. */
  readonly bindings?: readonly string[]
}

export type Match = 'exact' | 'folded' | 'sequence' | 'part' | 'label' | 'some'

const kPlain = 5

/** Converts the records of the server's CSV, the first of which names the columns, to answers. */
export class AnswerReader {
  /** Names of the query's variables, with their `$`. */
  variables: readonly string[] = []
  ranked = false
  private head?: readonly string[]
  private matched = false
  private first = kPlain
  private count = 0
  /** Shares equal texts between rows. */
  private readonly texts = new Map<string, string>()

  take(records: readonly string[][]): Answer[] {
    const answers: Answer[] = []
    for (const record of records) {
      if (!this.head) {
        this.head = record
        this.ranked = record[kPlain] === 'distance'
        this.matched = record[kPlain] === 'match'
        this.first = this.ranked || this.matched ? kPlain + 1 : kPlain
        this.variables = record.slice(this.first)
        continue
      }
      const answer: Answer = {
        at: this.count++,
        recording: this.text(record[0]),
        tier: this.text(record[1]),
        name: record[2],
        begin: Number(record[3]),
        end: Number(record[4]),
        distance: this.ranked ? Number(record[kPlain]) : undefined,
        ...(this.matched ? { match: record[kPlain] as Match } : {}),
        bindings: this.variables.length > 0 ? record.slice(this.first) : undefined,
      }
      answers.push(answer)
    }
    return answers
  }

  private text(value: string): string {
    const known = this.texts.get(value)
    if (known !== undefined) return known
    this.texts.set(value, value)
    return value
  }
}

/** Returns an answer's piece of a recording in the syntax of queries and utterances: `"meteo"@1200..3400`. */
export function pieceText({ recording, begin, end }: Pick<Answer, 'recording' | 'begin' | 'end'>): string {
  return `${quoted(recording)}@${begin}..${end}`
}

/** Quotes a text as queries read it. */
export function quoted(text: string): string {
  return `"${text.replace(/["\\]/g, '\\$&').replaceAll('\n', '\\n').replaceAll('\t', '\\t')}"`
}
