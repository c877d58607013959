import type { NoticeRow } from '../api/answers'
import type { Api } from '../api/client'
import { AnswerReader, type Answer } from './answers'
import { CsvReader } from './csv'

const kTellMs = 250

/** A query that is asked, and its answers as they come. What was found before stays until something else comes. */
export class Asking {
  status = $state<'idle' | 'asking' | 'answered' | 'stopped' | 'failed'>('idle')
  answers = $state.raw<readonly Answer[]>([])
  variables = $state.raw<readonly string[]>([])
  ranked = $state(false)
  notices = $state.raw<readonly NoticeRow[]>([])
  fault = $state.raw<unknown>()
  /** What was asked last. */
  text = $state('')
  /** To which the answers are. */
  answered = $state('')
  /** Whether all answers have come: not where it was stopped, or broke off. */
  whole = $state(true)
  /** Rises with every query that is answered, not with every piece of an answer. */
  number = $state(0)
  /** From the question to the last answer. */
  seconds = $state(0)
  private abort?: AbortController

  constructor(
    private readonly api: Api,
    private readonly database: string,
  ) {}

  async ask(text: string, limit?: number): Promise<void> {
    this.abort?.abort()
    const abort = (this.abort = new AbortController())
    this.text = text
    this.status = 'asking'
    this.fault = undefined
    this.notices = []
    const start = performance.now()
    try {
      const { csv, notices } = await this.api.find(this.database, { text, limit }, abort.signal)
      this.notices = notices
      await this.read(csv, text, abort.signal)
      if (abort.signal.aborted) return
      this.seconds = (performance.now() - start) / 1000
      this.status = 'answered'
    } catch (fault) {
      if (abort.signal.aborted) return
      this.fault = fault
      this.status = 'failed'
    }
  }

  /** Gives up what is under way. */
  stop(): void {
    this.abort?.abort()
    if (this.status === 'asking') this.status = !this.answered ? 'idle' : this.whole ? 'answered' : 'stopped'
  }

  /** As if nothing had been asked. */
  clear(): void {
    this.stop()
    this.status = 'idle'
    this.answers = []
    this.notices = []
    this.fault = undefined
    this.text = this.answered = ''
    this.whole = true
  }

  private async read(csv: ReadableStream<Uint8Array>, text: string, signal: AbortSignal): Promise<void> {
    const lines = new CsvReader(),
      reader = new AnswerReader()
    const come: Answer[] = []
    const decoder = new TextDecoder()
    const stream = csv.getReader()
    let told = 0
    const tell = () => {
      told = performance.now()
      this.answers = come.slice()
      this.whole = false
      if (this.answered !== text || come.length === 0) this.begin(reader, text)
    }
    for (let first = true; ; first = false) {
      const { value, done } = await stream.read()
      if (signal.aborted) return
      if (first) ++this.number
      if (done) break
      come.push(...reader.take(lines.push(decoder.decode(value, { stream: true }))))
      this.begin(reader, text)
      if (performance.now() - told > kTellMs) tell()
    }
    tell()
    this.whole = true
  }

  private begin(reader: AnswerReader, text: string): void {
    this.variables = reader.variables
    this.ranked = reader.ranked
    this.answered = text
  }
}
