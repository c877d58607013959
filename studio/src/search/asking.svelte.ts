import type { Notice } from '../api/schema'
import type { Api } from '../api/client'
import { AnswerReader, type Answer } from './answers'
import { CsvReader } from './csv'

const kUpdateMs = 250

/** A query, and its answers as they arrive. Previous answers stay until new ones arrive. */
export class Asking {
  status = $state<'idle' | 'asking' | 'answered' | 'stopped' | 'failed'>('idle')
  answers = $state.raw<readonly Answer[]>([])
  variables = $state.raw<readonly string[]>([])
  ranked = $state(false)
  notices = $state.raw<readonly Notice[]>([])
  fault = $state.raw<unknown>()
  /** The last query. */
  text = $state('')
  /** The query to which the answers belong. */
  answered = $state('')
  /** Whether all answers have arrived: not if it was stopped, or broke off. */
  whole = $state(true)
  /** Increases with every query answered, not with every part of an answer. */
  number = $state(0)
  /** From the request to the last answer. */
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

  /** Cancels the request in progress. */
  stop(): void {
    this.abort?.abort()
    if (this.status === 'asking') this.status = !this.answered ? 'idle' : this.whole ? 'answered' : 'stopped'
  }

  /** Resets to the initial state. */
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
    let lastUpdate = 0
    const update = () => {
      lastUpdate = performance.now()
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
      if (performance.now() - lastUpdate > kUpdateMs) update()
    }
    update()
    this.whole = true
  }

  private begin(reader: AnswerReader, text: string): void {
    this.variables = reader.variables
    this.ranked = reader.ranked
    this.answered = text
  }
}
