import type { WorkState } from '../ui/route'
import { carried } from './carry'
import { begun, did, redone, undone, type History } from './history'
import { duplicated, inserted, kEmpty, moved, removed, sameProject, withPlaces, type Place, type Project } from './project'
import { Newest } from './newest'
import { projectOf, stateOf } from './state'
import { utteranceOf, type Reading, type ReadText } from './utterance'

/** The subject of the side panel: a place, the junction before a place (by the place's id), or the whole project. */
export type Selected = { readonly kind: 'place' | 'junction'; readonly id: number } | { readonly kind: 'all' }

/** A text that cannot be read as signs, and why. */
export interface Unread {
  readonly text: string
  readonly fault: unknown
}

interface Kept {
  readonly history: History<Project>
  readonly written: string
  readonly unread?: Unread
  readonly wrong: readonly string[]
}
/**
 * The last composition of each database since the page was loaded, so that a returning user can continue. The address is written shortly after a step, so an
 * address left immediately still holds the previous state; `written` detects this.
 */
const kept = new Map<string, Kept>()

/** A project being edited; every step can be undone. */
export class Composition {
  private history = $state.raw<History<Project>>(begun(kEmpty))
  selected = $state.raw<Selected>({ kind: 'all' })
  readonly project = $derived(this.history.now)
  readonly canUndo = $derived(this.history.past.length > 0)
  readonly canRedo = $derived(this.history.future.length > 0)
  /** An address is being read. */
  following = $state(false)
  /** An unreadable text stays in the field until it is corrected. */
  private faulty = $state.raw<Unread | undefined>()
  /** The state written to the address last, as text; empty before the first. */
  private written = ''
  /** The names of parameters of the address that could not be read, until another address is written. */
  private wrong: readonly string[] = []
  /** No state was adopted yet. */
  private fresh = true
  private readonly reading = new Newest()

  constructor(
    private readonly database: string,
    private readonly read: ReadText,
  ) {}

  /**
   * Adopts the state of an address and returns the names of parameters that could not be read. An empty address continues with the previous state. A newer
   * address, and any change while this one is being read, takes precedence.
   */
  async follow(state: WorkState): Promise<readonly string[]> {
    const text = JSON.stringify(state)
    if (text === this.written) return []
    const says = Object.keys(state).length > 0,
      last = kept.get(this.database)
    this.written = text
    if (this.fresh && last && (!says || text === last.written)) {
      this.fresh = false
      this.history = last.history
      this.faulty = last.unread
      this.wrong = last.wrong
      this.settle()
      return this.wrong // The page that read the address may have been replaced before it could show them.
    }
    this.following = true
    const { utterance = '' } = state
    const outcome = await this.reading.run(
      async (signal) => (utterance === utteranceOf(this.project) ? this.project : await this.read(utterance, signal)),
      () => this.project,
    )
    if (outcome.kind === 'overtaken') return []
    const isFirst = this.fresh
    this.following = this.fresh = false
    if (outcome.kind === 'changed') return []
    const { project, wrong } = projectOf(state, outcome.kind === 'done' ? outcome.value : undefined)
    if (isFirst) this.history = begun(project)
    else if (!sameProject(this.project, project) && project.places.length > 0) this.change(project)
    if (says) this.faulty = outcome.kind === 'failed' ? { text: utterance, fault: outcome.fault } : undefined
    this.wrong = wrong
    this.settle()
    return wrong
  }
  get unread(): Unread | undefined {
    return this.faulty
  }
  set unread(unread: Unread | undefined) {
    this.faulty = unread
    this.keep()
  }
  /** Returns the state to write to the address; undefined if it is already there. */
  address(): WorkState | undefined {
    if (this.following) return undefined
    const state = stateOf(this.project)
    // An unreadable link stays as it is until there is something else to write.
    if (this.faulty !== undefined && this.project.places.length === 0) state.utterance = this.faulty.text
    const text = JSON.stringify(state)
    if (text === this.written) return undefined
    this.written = text
    this.wrong = []
    this.keep()
    return state
  }

  /** `of` names what is changed; further changes of the same are merged into one step. */
  change(next: Project, of?: string): void {
    if (next !== this.project) this.history = did(this.history, next, of, performance.now())
    this.settle()
  }
  undo(): void {
    this.history = undone(this.history)
    this.settle()
  }
  redo(): void {
    this.history = redone(this.history)
    this.settle()
  }

  /** Whether places can be changed one by one; otherwise only their text and their junctions can. */
  get byPlace(): boolean {
    return this.project.text === undefined
  }
  /** Replaces the places by those read from a text. */
  type({ places, text }: Pick<Reading, 'places' | 'text'>): void {
    const next = { ...withPlaces(this.project, carried(this.project.places, places)), ...(text !== undefined && { text }) }
    if (!sameProject(next, this.project)) this.change(next, 'text')
  }
  insert(at: number, ...places: readonly Place[]): void {
    if (!this.byPlace) return
    this.change(inserted(this.project, at, ...places))
    this.selected = { kind: 'place', id: places[places.length - 1].id }
  }
  /** Removes a place and selects the one that takes its position. */
  remove(at: number): void {
    if (!this.byPlace) return
    this.change(removed(this.project, at))
    const { places } = this.project
    const next = places[Math.min(at, places.length - 1)]
    this.selected = next ? { kind: 'place', id: next.id } : { kind: 'all' }
  }
  move(from: number, to: number): void {
    if (this.byPlace) this.change(moved(this.project, from, to))
  }
  duplicate(at: number): void {
    if (!this.byPlace) return
    this.change(duplicated(this.project, at))
    this.selected = { kind: 'place', id: this.project.places[at + 1].id }
  }

  /** Returns the index of the selected place; −1 if the whole project is selected. */
  indexOf(selected: Selected): number {
    return selected.kind === 'all' ? -1 : this.project.places.findIndex(({ id }) => id === selected.id)
  }

  /** Called after each step: saves the state for a returning user and resets a selection of a removed place or of the junction before the first place. */
  private settle(): void {
    this.keep()
    const at = this.indexOf(this.selected)
    if (this.selected.kind !== 'all' && at < (this.selected.kind === 'junction' ? 1 : 0)) this.selected = { kind: 'all' }
  }
  private keep(): void {
    kept.set(this.database, { history: this.history, written: this.written, unread: this.faulty, wrong: this.wrong })
  }
}
