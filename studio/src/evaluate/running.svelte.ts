import type { Api } from '../api/client'
import { ApiError } from '../api/fault'
import type { Evaluation } from './evaluation'

/** What the form asks for. */
export interface Wishes {
  readonly method: readonly string[]
  readonly seed: number
}
/** An evaluation that is shown, and the file that it was opened from. */
export interface Shown {
  readonly evaluation: Evaluation
  readonly file?: string
}

/** The evaluation of a database: goes on while other pages are looked at. */
export class Running {
  state = $state<'idle' | 'waiting' | 'running'>('idle')
  /** 0 to 1. */
  fraction = $state(0)
  fault = $state.raw<unknown>()
  cancelled = $state(false)
  shown = $state.raw<Shown | undefined>()
  private job = ''
  /** It is to be cancelled as soon as the server says which job it is, or can be reached again. */
  private unwanted = false
  /** Ends the wait for a server that could not be reached. */
  private wake?: () => void

  constructor(
    private readonly api: Api,
    private readonly database: string,
  ) {
    const job = remembered(database)
    if (job) void this.follow(job, true)
  }

  async start(wishes: Wishes): Promise<void> {
    if (this.state !== 'idle') return
    this.fault = undefined
    this.cancelled = false
    this.fraction = 0
    this.unwanted = false
    this.state = 'waiting'
    try {
      const { job } = await this.api.evaluate(this.database, wishes)
      remember(this.database, job)
      this.job = job
      if (this.unwanted) await this.cancel()
      await this.follow(job)
    } catch (fault) {
      this.fault = fault
      this.state = 'idle'
    }
  }

  async cancel(): Promise<void> {
    this.unwanted = !this.job
    if (!this.job) return
    try {
      await this.api.cancel(this.job)
    } catch (fault) {
      this.unwanted = true
      this.fault = fault
    }
  }

  /** Whether the server cannot be asked how far the job is. It is asked again by itself, and at once by `retry`. */
  get lost(): boolean {
    return this.state !== 'idle' && this.fault !== undefined
  }
  retry(): void {
    this.wake?.()
  }

  close(): void {
    this.shown = undefined
  }

  open(shown: Shown): void {
    this.fault = undefined
    this.shown = shown
  }

  /** `again` where the page was left: the server may have forgotten the job. */
  private async follow(job: string, again = false): Promise<void> {
    this.job = job
    this.state = 'waiting'
    for (let wait = kFirstWait; this.job; wait = Math.min(kLongestWait, 2 * wait)) {
      try {
        const evaluation = await this.api.result<Evaluation>(
          { job },
          ({ state, fraction }) => {
            if (state === 'waiting' || state === 'running') this.state = state
            this.fraction = fraction
            this.fault = undefined
            wait = kFirstWait
            if (this.unwanted) void this.cancel()
          },
          undefined,
          0,
        )
        this.end()
        this.open({ evaluation })
      } catch (fault) {
        // Of what the server did not say the job knows nothing: it goes on.
        const over = fault instanceof ApiError && (fault.status < 502 || fault.status > 504)
        if (!over) {
          this.fault = fault
          await this.pause(wait)
          continue
        }
        this.end()
        remember(this.database, '')
        if (fault.code === 'cancelled') this.cancelled = !again
        this.fault = fault.code === 'cancelled' || (again && fault.code === 'not_found') ? undefined : fault
      }
    }
  }
  private end(): void {
    this.state = 'idle'
    this.job = ''
  }
  private pause(ms: number): Promise<void> {
    return new Promise((resolve) => {
      const timer = setTimeout(resolve, ms)
      this.wake = () => {
        clearTimeout(timer)
        resolve()
      }
    })
  }
}

/** Ms to the next question where the server could not be reached, and at most. */
const kFirstWait = 1000
const kLongestWait = 8000

const running = new Map<string, Running>()
/** That of a database, the same as long as the page is open. */
export function runningOf(api: Api, database: string): Running {
  let one = running.get(database)
  if (!one) running.set(database, (one = new Running(api, database)))
  return one
}

const keyOf = (database: string) => `signweave.evaluation.${database}`
function remembered(database: string): string {
  try {
    return sessionStorage.getItem(keyOf(database)) ?? ''
  } catch {
    return ''
  }
}
function remember(database: string, job: string): void {
  try {
    sessionStorage.setItem(keyOf(database), job)
  } catch {
    // a page that may store nothing forgets it when it is closed
  }
}
