import { messageOf } from '../api/fault'
import { en } from '../text/en'

/** Ms between two progress reports. */
const kProgressMs = 500

/** The summary sent at the end of a render. */
export interface Done {
  readonly frames: number
  readonly seconds: number
  readonly codec: string
}

/** Sends results to the server that requested them, one after the other. After `done` or `fault` nothing more is sent. */
export class Delivery {
  private over = false
  /** When the last progress report was accepted, in ms of the page's clock; undefined while one is being sent. */
  private lastReport: number | undefined = -Infinity
  private queue: Promise<unknown> = Promise.resolve()

  constructor(private readonly put: string) {}

  /** Sends one file; resolves when the server has it, and rejects with the server's message if refused. */
  async file(name: string, body: Blob | ArrayBuffer): Promise<void> {
    if (!this.over) await this.send(name, body)
  }

  /** Reports the progress, unless it was reported in the last half second. */
  progress(done: number, of: number): void {
    if (this.over || this.lastReport === undefined || performance.now() - this.lastReport < kProgressMs) return
    this.lastReport = undefined
    this.send('progress', JSON.stringify({ done, of }))
      .catch((fault: unknown) => this.fault(fault))
      .finally(() => (this.lastReport = performance.now()))
  }

  async done(what: Done): Promise<void> {
    if (this.over) return
    this.over = true
    try {
      await this.send('done', JSON.stringify(what))
    } catch (fault) {
      this.over = false // so that the fault can be reported
      throw fault
    }
  }

  /** Ends the render with a one-line message. */
  fault(fault: unknown): void {
    if (this.over) return
    this.over = true
    const line = lineOf(fault)
    console.error(line)
    this.send('fault', line).catch((error: unknown) => console.error(lineOf(error)))
  }

  get ended(): boolean {
    return this.over
  }

  private send(name: string, body: Blob | ArrayBuffer | string): Promise<void> {
    const sent = this.queue.then(() => this.fetch(name, body))
    this.queue = sent.catch(() => {})
    return sent
  }

  private async fetch(name: string, body: Blob | ArrayBuffer | string): Promise<void> {
    const response = await fetch(`${this.put}/${name}`, { method: 'PUT', body }).catch(() => undefined)
    if (!response) throw new Error(`the server did not accept ${name}: it does not answer`)
    if (response.ok) return
    const said = await response.text().catch(() => '')
    throw new Error(`the server did not accept ${name}: ${messageIn(said) ?? `status ${response.status}`}`)
  }
}

/** Returns a fault as one line, never empty. */
export function lineOf(fault: unknown): string {
  return messageOf(fault, en).replace(/\s+/g, ' ').trim() || 'an unknown fault'
}

function messageIn(body: string): string | undefined {
  try {
    return (JSON.parse(body) as { error?: { message?: string } }).error?.message
  } catch {
    return undefined
  }
}
