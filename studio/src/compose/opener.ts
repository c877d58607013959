import type { Api } from '../api/client'
import { messageOf } from '../api/fault'
import type { Text } from '../text/en'
import { filled } from '../ui/preferences.svelte'
import { carried } from './carry'
import { played, type Scenario } from './examples'
import { readFile } from './file'
import { faultMessage, type ComposeText } from './messages'
import { Newest } from './newest'
import type { Project } from './project'
import { projectFrom } from './start'
import type { ReadText } from './utterance'

/** What an opener needs of its page. */
export interface OpenerPage {
  readonly api: Api
  readonly database: string
  readonly read: ReadText
  /** The project that a newly opened one would replace. */
  project(): Project
  /** Replaces the project; `withOriginal` says whether its original is shown next to it, if that is known. */
  open(project: Project, withOriginal?: boolean): Promise<void>
  notify(said: string, wrong?: boolean): void
  texts(): { readonly text: ComposeText; readonly common: Text }
}

/** Opens projects, from files and from recordings. Only the newest request counts, and it never replaces later changes by the user. */
export class Opener {
  private readonly opening = new Newest()

  constructor(private readonly page: OpenerPage) {}

  async file(file: File): Promise<void> {
    const { page } = this,
      { text, common } = page.texts()
    const outcome = await this.opening.run(
      (signal) => this.read(file, signal),
      () => page.project(),
    )
    if (outcome.kind === 'overtaken') return
    if (outcome.kind === 'changed') return page.notify(filled(text.changedMeanwhile, { name: file.name }), true)
    if (outcome.kind === 'failed') return page.notify(`${file.name}: ${faultMessage(outcome.fault, text, common)}`, true)
    const { project, database: of } = outcome.value
    await page.open(project)
    page.notify(of !== undefined && of !== page.database ? filled(text.otherDatabase, { name: of }) : '')
  }

  async recording(name: string, scenario?: Scenario): Promise<void> {
    const { page } = this,
      { text, common } = page.texts()
    page.notify(common.loading)
    const outcome = await this.opening.run(
      (signal) => projectFrom(page.api, page.database, name, signal),
      () => page.project(),
    )
    if (outcome.kind === 'overtaken') return
    if (outcome.kind === 'changed') return page.notify(filled(text.changedMeanwhile, { name }), true)
    if (outcome.kind === 'failed') return page.notify(messageOf(outcome.fault, common), true)
    const next = scenario ? played(scenario, outcome.value) : outcome.value
    if (!next || next.places.length === 0) return page.notify(filled(text.noSignsThere, { name }), true)
    await page.open(next, scenario !== undefined)
    page.notify('')
  }

  stop(): void {
    this.opening.stop()
  }

  /** Reads a file. What a text with parts says counts, if the places beside it say something else. */
  private async read(file: File, signal: AbortSignal) {
    const opened = readFile(await file.text())
    if (opened.project.text === undefined) return opened
    const { places, text } = await this.page.read(opened.project.text, signal)
    return { ...opened, project: { ...opened.project, places: carried(opened.project.places, places), text } }
  }
}
