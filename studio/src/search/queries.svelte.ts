import { asked, keep, merged, readKept, remove, rename, restore, type Kept, type SavedQuery } from './saved'

const kKey = 'signweave.queries'

/** The user's queries stored in this browser. */
export class Queries {
  kept = $state.raw<Kept>(read())
  /** Set if the browser cannot store anything: the queries then last until the page is left. */
  unstored = $state(false)
  /** The last query that was removed or replaced by another of its name, and its position. */
  removed = $state.raw<{ readonly query: SavedQuery; readonly at: number; readonly replaced: boolean } | undefined>()

  /** Returns the query with a name; undefined if the name is free. */
  named(name: string): SavedQuery | undefined {
    return this.kept.saved.find((one) => one.name === name.trim())
  }
  keep(name: string, text: string): void {
    // Another window may have saved one with that name meanwhile.
    const { saved } = this.unstored ? this.kept : read()
    const at = saved.findIndex((one) => one.name === name.trim())
    this.removed = at >= 0 && saved[at].text !== text.trim() ? { query: saved[at], at, replaced: true } : undefined
    this.change((kept) => keep(kept, name.trim(), text.trim()))
  }
  rename(from: string, to: string): void {
    this.change((kept) => rename(kept, from, to))
  }
  remove(name: string): void {
    const at = this.kept.saved.findIndex((one) => one.name === name)
    if (at >= 0) this.removed = { query: this.kept.saved[at], at, replaced: false }
    this.change((kept) => remove(kept, name))
  }
  undo(): void {
    const { removed } = this
    if (removed) this.change((kept) => restore(kept, removed.query, Math.min(removed.at, kept.saved.length), removed.replaced))
    this.removed = undefined
  }
  asked(text: string): void {
    this.change((kept) => asked(kept, text))
  }
  add(more: readonly SavedQuery[]): void {
    this.change((kept) => merged(kept, more))
  }

  /** Another window may have changed them meanwhile: the stored state counts. */
  private change(to: (kept: Kept) => Kept): void {
    this.kept = to(this.unstored ? this.kept : read())
    try {
      localStorage.setItem(kKey, JSON.stringify(this.kept))
      this.unstored = false
    } catch {
      this.unstored = true
    }
  }
}

function read(): Kept {
  try {
    return readKept(localStorage.getItem(kKey))
  } catch {
    return readKept(undefined)
  }
}
