import { wordsOf } from '../api/fault'
import { en } from '../text/en'

/** Between two words on progress, ms. */
const kProgressMs = 500

/** What is put at the end of a render. */
export interface Done { readonly frames: number; readonly seconds: number; readonly codec: string }

/** Puts what was rendered to the server that asked for it. After `done` or `fault` nothing more goes out. */
export class Delivery {
  private over = false
  private told = -Infinity
  private telling: Promise<void> = Promise.resolve()

  constructor(private readonly put: string) {}

  /** One file; resolves when the server has it, and rejects with what the server says where it did not take it. */
  async file(name: string, body: Blob | ArrayBuffer | string): Promise<void> {
    if (this.over) throw new Error('the render has ended')
    await this.send(name, body)
  }

  /** Says how far it is, where it was not said in the last half second. */
  progress(done: number, of: number): void {
    const now = performance.now()
    if (this.over || now - this.told < kProgressMs) return
    this.told = now
    this.telling = this.telling.then(() => this.send('progress', JSON.stringify({ done, of })))
    // A word on progress that is refused ends the render like everything else, but only once.
    this.telling.catch((fault: unknown) => this.fault(fault))
  }

  async done(what: Done): Promise<void> {
    await this.telling
    if (this.over) return
    this.over = true
    await this.send('done', JSON.stringify(what))
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

  private async send(name: string, body: Blob | ArrayBuffer | string): Promise<void> {
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
