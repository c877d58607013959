import type { WorkState } from '../ui/route'
import { carried } from './carry'
import { begun, did, redone, undone, type History } from './history'
import { duplicated, inserted, kEmpty, moved, removed, sameProject, withPlaces, type Place, type Project } from './project'
import { projectOf, stateOf } from './state'

/** What the panel beside the picture is about: a place, the junction before a place (by the place's id), or all of it. */
export type Selected = { readonly kind: 'place' | 'junction'; readonly id: number } | { readonly kind: 'all' }

/** What was composed last of each database since the page was loaded: whoever comes back goes on with it. */
const kept = new Map<string, Project>()

/** A project while somebody works on it: every step can be taken back. */
export class Composition {
  private history = $state.raw<History<Project>>(begun(kEmpty))
  selected = $state.raw<Selected>({ kind: 'all' })
  readonly project = $derived(this.history.now)
  readonly canUndo = $derived(this.history.past.length > 0)
  readonly canRedo = $derived(this.history.future.length > 0)
  /** The state that the address was given last, as text. */
  private written = ''

  constructor(private readonly database: string) {}

  /** Takes over what an address says; names what in it could not be read. An address without anything goes on with what was there. */
  follow(state: WorkState): readonly string[] {
    const text = JSON.stringify(state)
    if (text === this.written) return []
    const { project, wrong } = projectOf(state)
    const wanted = Object.keys(state).length > 0 ? project : kept.get(this.database) ?? project
    this.written = text
    if (this.history.now === kEmpty) {
      this.history = begun(wanted)
      this.settle()
    }
    if (!sameProject(this.project, wanted) && wanted.places.length > 0) this.change(wanted)
    return wrong
  }
  /** What the address should say; none where it says so already. */
  address(): WorkState | undefined {
    const state = stateOf(this.project), text = JSON.stringify(state)
    if (text === this.written) return undefined
    this.written = text
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
    kept.set(this.database, this.project)
    const at = this.indexOf(this.selected)
    if (this.selected.kind !== 'all' && at < (this.selected.kind === 'junction' ? 1 : 0)) this.selected = { kind: 'all' }
  }
}
