import { PageFault } from '../fault'
import { isSame, merged, votesIn, withTurn } from './merge'
import { readStudy } from './read_study'
import type { Study } from './study'

/** What this browser stores; `unreadable` if there is something, but no study that this page can show. */
export interface Kept {
  readonly study?: Study
  readonly unreadable?: boolean
}

/** The study of a database as stored in this browser, shared by all tabs; each tab has its own current participant. */
export class Shelf {
  readonly key: string
  private readonly turnKey: string
  /** The text as last read or written here: any other text was written by another tab. */
  private text: string | null = null

  constructor(database: string) {
    this.key = `signweave.study.${database}`
    this.turnKey = `signweave.study.turn.${database}`
  }

  read(): Kept {
    let turn: string | null
    try {
      this.text = localStorage.getItem(this.key)
      turn = sessionStorage.getItem(this.turnKey)
    } catch {
      return {} // if storage is forbidden, there is no study
    }
    return this.parsed(turn ?? undefined)
  }

  /** Merges another tab's change into this tab's study. */
  heard(mine: Study | undefined): Kept {
    const kept = this.read(),
      { study } = kept
    if (!study || !mine || !isSame(mine, study)) return kept.study ? { study: withTurn(kept.study, undefined) } : kept
    const both = withTurn(merged(mine, study), mine.current)
    // Two tabs wrote at once, and the other's text does not contain everything.
    return { study: votesIn(both) > votesIn(study) ? this.write(both) : both }
  }

  /** Merges a study with other tabs' changes, stores it and returns it. Throws if nothing can be stored, or if there is another study by now. */
  write(study: Study): Study {
    let now = study
    let stored: string | null
    try {
      stored = localStorage.getItem(this.key)
    } catch {
      throw new PageFault('noStorage')
    }
    // Deleted in another tab while this one had a vote: the vote counts.
    if (stored !== null && stored !== this.text) {
      this.text = stored
      const theirs = this.parsed().study
      if (!theirs || !isSame(study, theirs)) throw new PageFault('otherStudy')
      now = withTurn(merged(study, theirs), study.current)
    }
    const { current, ...rest } = now
    const text = JSON.stringify(rest)
    try {
      localStorage.setItem(this.key, text)
      if (current === undefined) sessionStorage.removeItem(this.turnKey)
      else sessionStorage.setItem(this.turnKey, turnOf(now, current))
    } catch {
      throw new PageFault('noStorage')
    }
    this.text = text
    return now
  }

  remove(): void {
    this.text = null
    try {
      localStorage.removeItem(this.key)
      sessionStorage.removeItem(this.turnKey)
    } catch {
      throw new PageFault('noStorage')
    }
  }

  /** Returns the stored text, so that it can be saved even if it is unreadable. */
  raw(): string {
    return this.text ?? ''
  }

  private parsed(turn?: string): Kept {
    if (this.text === null) return {}
    try {
      const study = readStudy(this.text),
        of = turnOf(study, '')
      return { study: withTurn(study, turn?.startsWith(of) ? turn.slice(of.length) : undefined) }
    } catch {
      return { unreadable: true }
    }
  }
}

/** The tab's entry: a participant with the same code in another study is a different one. */
const turnOf = ({ at }: Study, participant: string) => `${at} ${participant}`
