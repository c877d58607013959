import type { Api } from '../api/client'
import { ApiError } from '../api/fault'
import type { Evaluation } from './evaluation'

/** What the form asks for. */
export interface Wishes { readonly method: readonly string[]; readonly seed: number }
/** An evaluation that is shown, and the file that it was opened from. */
export interface Shown { readonly evaluation: Evaluation; readonly file?: string }

/** The evaluation of a database: goes on while other pages are looked at. */
export class Running {
  state = $state<'idle' | 'waiting' | 'running'>('idle')
  /** 0 to 1. */
  fraction = $state(0)
  fault = $state.raw<unknown>()
  cancelled = $state(false)
  shown = $state.raw<Shown | undefined>()
  private job = ''

  constructor(private readonly api: Api, private readonly database: string) {
    const job = remembered(database)
    if (job) void this.follow(job, true)
  }

  async start(wishes: Wishes): Promise<void> {
    if (this.state !== 'idle') return
    this.fault = undefined
    this.cancelled = false
    this.fraction = 0
    this.state = 'waiting'
    try {
      const { job } = await this.api.evaluate(this.database, wishes)
      remember(this.database, job)
      await this.follow(job)
    } catch (fault) {
      this.fault = fault
      this.state = 'idle'
    }
  }

  async cancel(): Promise<void> {
    try {
      if (this.job) await this.api.cancel(this.job)
    } catch (fault) {
      this.fault = fault
    }
  }

  open(shown: Shown): void {
    this.fault = undefined
    this.shown = shown
  }

  /** `again` where the page was left: the server may have forgotten the job. */
  private async follow(job: string, again = false): Promise<void> {
    this.job = job
    this.state = 'waiting'
    try {
      const evaluation = await this.api.result<Evaluation>({ job }, ({ state, fraction }) => {
        if (state === 'waiting' || state === 'running') this.state = state
        this.fraction = fraction
      })
      this.open({ evaluation })
    } catch (fault) {
      const over = fault instanceof ApiError
      if (over) remember(this.database, '')
      if (over && fault.code === 'cancelled') this.cancelled = !again
      else if (!again || !over || fault.code !== 'not_found') this.fault = fault
    } finally {
      this.state = 'idle'
      this.job = ''
    }
  }
}

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
