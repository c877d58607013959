import type { WorkState } from '../ui/route'
import { carried } from './carry'
import { begun, did, redone, undone, type History } from './history'
import { duplicated, inserted, kEmpty, moved, removed, sameProject, withPlaces, type Place, type Project } from './project'
import { projectOf, stateOf } from './state'

/** What the panel beside the picture is about: a place, the junction before a place (by the place's id), or all of it. */
export type Selected = { readonly kind: 'place' | 'junction'; readonly id: number } | { readonly kind: 'all' }

interface Kept {
  readonly history: History<Project>
  readonly written: string
  readonly unread?: string
}
/**
 * What was composed last of each database since the page was loaded: whoever comes back goes on with it. The address is written a
 * little after a step, so that one that was left at once still says what was before; it is told by `written`.
 */
const kept = new Map<string, Kept>()

/** A project while somebody works on it: every step can be taken back. */
export class Composition {
  private history = $state.raw<History<Project>>(begun(kEmpty))
  selected = $state.raw<Selected>({ kind: 'all' })
  readonly project = $derived(this.history.now)
  readonly canUndo = $derived(this.history.past.length > 0)
  readonly canRedo = $derived(this.history.future.length > 0)
  /** A text in which signs cannot be read: it stands in the field until it is put right. */
  private faulty = $state.raw<string | undefined>()
  /** The state that the address was given last, as text; empty before the first. */
  private written = ''

  constructor(private readonly database: string) {}

  /** Takes over what an address says; names what in it could not be read. An address without anything goes on with what was there. */
  follow(state: WorkState): readonly string[] {
    const text = JSON.stringify(state)
    if (text === this.written) return []
    const { project, wrong, unread } = projectOf(state)
    const isFirst = this.written === '',
      says = Object.keys(state).length > 0,
      last = kept.get(this.database)
    this.written = text
    if (isFirst && last && (!says || text === last.written)) {
      this.history = last.history
      this.faulty = last.unread
    } else {
      if (isFirst) this.history = begun(project)
      else if (!sameProject(this.project, project) && project.places.length > 0) this.change(project)
      if (says) this.faulty = unread
    }
    this.settle()
    return wrong
  }
  get unread(): string | undefined {
    return this.faulty
  }
  set unread(text: string | undefined) {
    this.faulty = text
    this.keep()
  }
  /** What the address should say; none where it says so already. */
  address(): WorkState | undefined {
    const state = stateOf(this.project)
    // A link that cannot be read stays what it is, until there is something else to say.
    if (this.faulty !== undefined && this.project.places.length === 0) state.utterance = this.faulty
    const text = JSON.stringify(state)
    if (text === this.written) return undefined
    this.written = text
    this.keep()
    return state
  }

  /** `of` names what is changed, where further changes of it are the same step. */
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

  /** Places as a text has them now. */
  type(places: readonly Place[]): void {
    const next = withPlaces(this.project, carried(this.project.places, places))
    if (!sameProject(next, this.project)) this.change(next, 'text')
  }
  insert(at: number, ...places: readonly Place[]): void {
    this.change(inserted(this.project, at, ...places))
    this.selected = { kind: 'place', id: places[places.length - 1].id }
  }
  /** Takes a place out; what stands there then is selected. */
  remove(at: number): void {
    this.change(removed(this.project, at))
    const { places } = this.project
    const next = places[Math.min(at, places.length - 1)]
    this.selected = next ? { kind: 'place', id: next.id } : { kind: 'all' }
  }
  move(from: number, to: number): void {
    this.change(moved(this.project, from, to))
  }
  duplicate(at: number): void {
    this.change(duplicated(this.project, at))
    this.selected = { kind: 'place', id: this.project.places[at + 1].id }
  }

  /** Where the place stands that the selection is about; −1 where it is about all. */
  indexOf(selected: Selected): number {
    return selected.kind === 'all' ? -1 : this.project.places.findIndex(({ id }) => id === selected.id)
  }

  /** After each step: it is kept for whoever comes back. A selection of what is gone, or of the junction before the first place, is none. */
  private settle(): void {
    this.keep()
    const at = this.indexOf(this.selected)
    if (this.selected.kind !== 'all' && at < (this.selected.kind === 'junction' ? 1 : 0)) this.selected = { kind: 'all' }
  }
  private keep(): void {
    kept.set(this.database, { history: this.history, written: this.written, unread: this.faulty })
  }
}
