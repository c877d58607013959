import { PageFault } from '../fault'
import { isSame, merged, votesIn, withTurn } from './merge'
import { readStudy } from './read_study'
import type { Study } from './study'

/** What this browser keeps; `unreadable` where there is something, but no study that this page can show. */
export interface Kept {
  readonly study?: Study
  readonly unreadable?: boolean
}

/** The study of a database as this browser keeps it, for all tabs; whose turn it is each tab knows by itself. */
export class Shelf {
  readonly key: string
  private readonly turnKey: string
  /** As it was last read or written here: who wrote something else was another tab. */
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
      return {} // a page that may store nothing has nothing
    }
    return this.parsed(turn ?? undefined)
  }

  /** What another tab changed, taken into what this one has. */
  heard(mine: Study | undefined): Kept {
    const kept = this.read(),
      { study } = kept
    if (!study || !mine || !isSame(mine, study)) return kept.study ? { study: withTurn(kept.study, undefined) } : kept
    const both = withTurn(merged(mine, study), mine.current)
    // Two wrote at once, and what the other wrote has not got all of it.
    return { study: votesIn(both) > votesIn(study) ? this.write(both) : both }
  }

  /** Keeps a study with what other tabs have put into it since, and gives that. Throws where nothing can be kept, or where there is another study by now. */
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

  /** As it lies there, to be saved also where nobody can read it. */
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

/** As a tab keeps it: somebody of the same code in another study is somebody else. */
const turnOf = ({ at }: Study, participant: string) => `${at} ${participant}`
