import type { Api } from '../api/client'
import { ApiError } from '../api/fault'
import type { Evaluation } from './evaluation'

/** The options chosen in the form. */
export interface EvaluationOptions {
  readonly method: readonly string[]
  readonly seed: number
}
/** An evaluation on screen, and the file from which it was opened. */
export interface Shown {
  readonly evaluation: Evaluation
  readonly file?: string
}

/** The evaluation of a database: continues while other pages are open. */
export class Running {
  state = $state<'idle' | 'waiting' | 'running'>('idle')
  /** 0 to 1. */
  fraction = $state(0)
  fault = $state.raw<unknown>()
  cancelled = $state(false)
  shown = $state.raw<Shown | undefined>()
  private job = ''
  /** Cancellation is pending until the server returns the job's id, or is reachable again. */
  private unwanted = false
  /** Ends the wait for an unreachable server. */
  private wake?: () => void

  constructor(
    private readonly api: Api,
    private readonly database: string,
  ) {
    const job = remembered(database)
    if (job) void this.follow(job, true)
  }

  async start(options: EvaluationOptions): Promise<void> {
    if (this.state !== 'idle') return
    this.fault = undefined
    this.cancelled = false
    this.fraction = 0
    this.unwanted = false
    this.state = 'waiting'
    try {
      const { job } = await this.api.evaluate(this.database, options)
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

  /** Whether the server cannot be reached to query the job. Queries are repeated automatically, and at once by `retry`. */
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

  /** `again` after the page was left: the server may have forgotten the job. */
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
        // An error that did not come from the server does not affect the job, which continues.
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

/** Initial and maximum ms between queries of an unreachable server. */
const kFirstWait = 1000
const kLongestWait = 8000

const running = new Map<string, Running>()
/** Returns the evaluation of a database, the same one as long as the page is open. */
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
    // if storage is forbidden, it is forgotten when the page is closed
  }
}
