import { wordsOf } from '../api/fault'
import { en } from '../text/en'

/** Between two words on progress, ms. */
const kProgressMs = 500

/** What is put at the end of a render. */
export interface Done {
  readonly frames: number
  readonly seconds: number
  readonly codec: string
}

/** Puts what was rendered to the server that asked for it, one thing after the other. After `done` or `fault` nothing more goes out. */
export class Delivery {
  private over = false
  /** When a word on progress was last taken, ms of the page's clock; none while one is on its way. */
  private told: number | undefined = -Infinity
  private queue: Promise<unknown> = Promise.resolve()

  constructor(private readonly put: string) {}

  /** One file; resolves when the server has it, and rejects with what the server says where it did not take it. */
  async file(name: string, body: Blob | ArrayBuffer): Promise<void> {
    if (!this.over) await this.send(name, body)
  }

  /** Says how far it is, where that was not said in the last half second. */
  progress(done: number, of: number): void {
    if (this.over || this.told === undefined || performance.now() - this.told < kProgressMs) return
    this.told = undefined
    this.send('progress', JSON.stringify({ done, of }))
      .catch((fault: unknown) => this.fault(fault))
      .finally(() => (this.told = performance.now()))
  }

  async done(what: Done): Promise<void> {
    if (this.over) return
    this.over = true
    try {
      await this.send('done', JSON.stringify(what))
    } catch (fault) {
      this.over = false // so that it can be told
      throw fault
    }
  }

  /** Ends the render with one plain line. */
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
    if (!response) throw new Error(`the server did not take ${name}: it does not answer`)
    if (response.ok) return
    const said = await response.text().catch(() => '')
    throw new Error(`the server did not take ${name}: ${messageIn(said) ?? `status ${response.status}`}`)
  }
}

/** A fault as one line, never empty. */
export function lineOf(fault: unknown): string {
  return wordsOf(fault, en).replace(/\s+/g, ' ').trim() || 'something went wrong that has no name'
}

function messageIn(body: string): string | undefined {
  try {
    return (JSON.parse(body) as { error?: { message?: string } }).error?.message
  } catch {
    return undefined
  }
}
