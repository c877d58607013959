import type { Answered } from '../api/client'
import { parseRoute } from '../ui/route'
import { begin, finish, goTo, looked, readProgress, stepAt, type Progress } from './progress'
import type { About, Path } from './steps'

const kKey = 'signweave.guide'
/** The number of calls remembered, enough for every step. */
const kMostCalls = 200

interface Stage {
  readonly transport: { readonly playing: boolean; readonly speed: number; readonly loop: unknown }
}

/** The user's guided path, as long as this browser remembers it. */
class Guide {
  progress = $state.raw<Progress | undefined>(read())
  /** The step that has just been recognised as done. */
  justDone = $state('')
  private calls: Answered[] = []
  /** The number in the path's database; unknown until the panel has reported it. */
  private recordings: number | undefined

  /** The path that the panel follows. */
  get under(): Progress | undefined {
    return this.progress?.under ? this.progress : undefined
  }

  begin(path: Path, about: About): void {
    this.change(begin(path, about))
  }
  resume(): void {
    if (this.progress) this.change({ ...this.progress, under: true })
  }
  leave(): void {
    if (this.progress) this.change({ ...this.progress, under: false })
  }
  back(): void {
    if (this.progress) this.step(goTo(this.progress, this.progress.step - 1))
  }
  /** `done` if the user confirms the step; otherwise it is skipped. */
  next(done: boolean): void {
    if (this.progress) this.step(done ? finish(this.progress) : goTo(this.progress, this.progress.step + 1))
  }
  private step(progress: Progress): void {
    this.change(progress)
    if (this.recordings !== undefined) this.look(this.recordings)
  }

  heard(call: Answered): void {
    if (this.progress?.under && this.calls.length < kMostCalls) this.calls.push(call)
  }

  /** Checks where the user is, a few times a second: pages change the address without an event. */
  look(recordings: number): void {
    const { under } = this
    if (!under) return
    this.recordings = recordings
    const stage = (window as { signweaveStage?: Stage }).signweaveStage?.transport
    const now = looked(under, {
      route: parseRoute(location.hash),
      playing: stage?.playing ?? false,
      speed: stage?.speed ?? 1,
      selected: Boolean(stage?.loop),
      calls: this.calls,
      recordings,
    })
    if (now === under) return
    const id = now.step !== under.step ? stepAt(under)?.id : undefined
    this.change(now)
    if (id) this.justDone = id
    // If the next step is already done, this is known at once.
    if (id) this.look(recordings)
  }

  private change(progress: Progress): void {
    if (progress.step !== this.progress?.step || progress.path !== this.progress.path || progress.under !== this.progress.under) {
      this.calls = []
      this.justDone = ''
    }
    this.progress = progress
    try {
      localStorage.setItem(kKey, JSON.stringify(progress))
    } catch {
      // if storage is forbidden, it is forgotten when the page is closed
    }
  }
}

function read(): Progress | undefined {
  try {
    return readProgress(localStorage.getItem(kKey))
  } catch {
    return undefined
  }
}
export const guide = new Guide()
