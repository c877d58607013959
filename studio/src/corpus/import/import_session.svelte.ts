import type { Api } from '../../api/client'
import type { FilePart, FormatRow, Imported, ImportResult, Inspected, Inspection, Notice } from '../../api/corpus_answers'
import { formats, isWritable, previewUpload } from '../../api/corpus_calls'
import type { OpenedMotion } from '../../motion/source'
import { wholeMotion } from '../../motion/whole_motion'
import { grouped, kNone, readRig, type Corrections, type Group } from './corrections'
import { endingOf, isRefusal, stemOf } from './file_kinds'
import { added, kNoFiles, sendable, withFolderNames, without, type FileList, type Picked } from './file_list'
import { extended, keyOf, paired, readTable, tableOf, type Pair, type TableFault } from './pairs'
import { failedBy, isCancelled, isOfTheCall, withGood } from './reports'
import { Revisions } from './revisions'
import { isGone, Sender } from './sender.svelte'
import { UploadJobs, type Doing } from './upload_jobs'

const kParts: readonly FilePart[] = ['motion', 'annotation', 'face']
const kTable = 'pairs.csv'
/** After a correction, ms until the report is made anew: several go together. */
const kSettle = 700

/** One import from choosing files to what became of them. It outlives the page, so that nothing is lost where somebody looks at something else. */
export class ImportSession {
  formats = $state.raw<readonly FormatRow[]>([])
  writable = $state<boolean | undefined>()
  list = $state.raw<FileList>(kNoFiles)
  readonly sender: Sender
  doing = $state.raw<Doing | undefined>()
  /** What went wrong last with all of it, and how that is tried again. */
  fault = $state.raw<unknown>()
  retry?: () => void
  /** Files came or were to go while something was under way: that was not done. */
  turnedAway = $state(false)
  reports = $state.raw<readonly Inspected[]>([])
  notices = $state.raw<readonly Notice[]>([])
  faults = $state.raw<readonly string[]>([])
  /** What the server said of a recording's corrections, where it did not take them. */
  refused = $state.raw<ReadonlyMap<string, unknown>>(new Map())
  /** Recordings whose report is from before what was corrected. */
  stale = $state.raw<ReadonlySet<string>>(new Set())
  /** Which files belong together where somebody said so. */
  pairs = $state.raw<readonly Pair[] | undefined>()
  tableFaults = $state.raw<readonly TableFault[]>([])
  all = $state.raw<Corrections>(kNone)
  own = $state.raw<ReadonlyMap<string, Corrections>>(new Map())
  /** Recordings that are not to be imported. */
  left = $state.raw<ReadonlySet<string>>(new Set())
  outcomes = $state.raw<ReadonlyMap<string, Imported>>(new Map())
  onimported?: () => void
  /** Files that came before it was known what the server can read. */
  private early: readonly Picked[] = []
  private readonly jobs: UploadJobs
  private settling = $state.raw<ReturnType<typeof setTimeout>>()
  private readonly revisions = new Revisions()

  constructor(
    private readonly api: Api,
    private readonly database: string,
  ) {
    this.sender = new Sender(api, database)
    this.jobs = new UploadJobs(api, database, this.sender, () => sendable(this.list))
    void this.begin()
  }

  /** Asks what the server can read, and whether it may be given anything. */
  async begin(): Promise<void> {
    this.fault = undefined
    try {
      ;[this.formats, this.writable] = await Promise.all([formats(this.api), isWritable(this.api, this.database)])
      const { early } = this
      this.early = []
      if (this.writable && early.length > 0) await this.add(early)
    } catch (fault) {
      this.fail(fault, () => void this.begin())
    }
  }
  fail(fault: unknown, retry?: () => void): void {
    this.fault = fault
    this.retry = retry
  }

  /** Whether files are being sent, looked at or stored. */
  get busy(): boolean {
    return this.sender.busy || this.doing !== undefined
  }
  /** Recordings that were corrected while nobody looks at them, nor is about to. */
  get unlooked(): readonly string[] {
    return this.busy || this.settling !== undefined ? [] : [...this.stale]
  }
  /** The names of the files that can be a part of a recording. */
  filesOf(part: FilePart): readonly string[] {
    return this.list.files.filter(({ kind, clash }) => kind === part && !clash).map(({ name }) => name)
  }
  /** The recordings that are to be imported and are not there yet, but for those whose corrections are not taken. */
  get wanted(): readonly Inspected[] {
    return this.reports.filter((one) => {
      const key = keyOf(one.files)
      return !one.error && !this.left.has(key) && !this.isStored(key) && (!this.refused.has(key) || this.stale.has(key))
    })
  }
  private isStored(key: string): boolean {
    const outcome = this.outcomes.get(key)?.outcome
    return outcome !== undefined && outcome !== 'failed'
  }
  /** Files of recordings that are in none, where somebody said which belong together. */
  get unused(): readonly string[] {
    const used = new Set(this.pairs?.flatMap(({ motion, annotation, face }) => [motion, annotation, face]))
    return this.pairs ? kParts.flatMap((part) => this.filesOf(part)).filter((name) => !used.has(name)) : []
  }
  outcomeOf(one: Inspected): Imported | undefined {
    return this.outcomes.get(keyOf(one.files))
  }

  async add(more: readonly Picked[]): Promise<void> {
    if (this.writable === undefined) {
      this.early = [...this.early, ...more]
      return
    }
    if (this.isTurnedAway()) return
    // What was stored is over: more files are another import.
    if (this.outcomes.size > 0 && this.wanted.length === 0) this.clear()
    this.change(added(this.list, more, this.formats))
    await this.readTables()
  }
  /** Takes files out. Reports of recordings that had one are made anew, the others stay. */
  remove(ids: readonly number[]): void {
    if (this.isTurnedAway()) return
    const gone = this.list.files.filter(({ id }) => ids.includes(id))
    const list = without(this.list, ids, this.formats)
    const isPart = (kind: string) => kParts.some((part) => part === kind)
    // Of what is read with others, or was kept back, nobody knows which reports it is about.
    if (this.reports.length === 0 || gone.some(({ kind, clash }) => clash || !(isRefusal(kind) || isPart(kind)))) return this.change(list)
    const before = this.table()
    this.list = list
    if (gone.every(({ kind }) => isRefusal(kind))) return
    this.repair(before, this.extended(before))
  }
  renameClashes(): void {
    if (this.isTurnedAway()) return
    this.change(withFolderNames(this.list, this.formats))
  }
  /** What is under way is of the files that there are: others wait until it is over. */
  private isTurnedAway(): boolean {
    return (this.turnedAway = this.busy)
  }
  /** Begins anew, without anything. */
  clear(): void {
    this.unsettle()
    this.sender.forget()
    this.list = kNoFiles
    this.forgetReports()
    this.all = kNone
    this.own = new Map()
    this.left = new Set()
    this.tableFaults = []
    this.pairs = undefined
    this.fault = undefined
    this.turnedAway = false
  }

  /** Sends what was not sent, and looks at all of it. */
  async send(again = false): Promise<void> {
    this.fault = undefined
    this.turnedAway = false
    const files = sendable(this.list)
    try {
      if (await this.sender.send(files)) await this.inspect()
    } catch (fault) {
      if (isGone(fault) && !again) {
        this.sender.forget()
        return this.send(true)
      }
      this.fail(fault, () => void this.send())
    }
  }

  cancel(): void {
    this.sender.cancel()
    this.jobs.cancel().catch((fault: unknown) => this.fail(fault))
  }

  correctAll(corrections: Corrections): void {
    this.all = corrections
    this.touched(this.reports.map(({ files }) => keyOf(files)))
  }
  correct(key: string, corrections: Corrections): void {
    this.own = new Map(this.own).set(key, corrections)
    this.touched([key])
  }
  /** Another file as a part of a recording, or none. */
  pair(key: string, part: FilePart, file: string | null): void {
    const before = this.table()
    const after = paired(before, key, part, file, this.stemOf)
    if (after !== before) this.repair(before, after)
  }
  private repair(before: readonly Pair[], after: readonly Pair[]): void {
    const told = new Set(before.map((one) => JSON.stringify(one))),
      here = new Set(after.map(keyOf))
    this.pairs = after
    const over = this.reports.map(({ files }) => keyOf(files)).filter((key) => !here.has(key))
    this.touched([...over, ...after.filter((one) => !told.has(JSON.stringify(one))).map(keyOf)])
  }
  /** The keys of recordings that there still are, as somebody said which files belong together. */
  private present(keys: Iterable<string>): readonly string[] {
    if (!this.pairs) return [...keys]
    const here = new Set(this.pairs.map(keyOf))
    return [...keys].filter((key) => here.has(key))
  }
  private forgetGone(): void {
    const here = new Set(this.present([...this.stale, ...this.refused.keys(), ...this.reports.map(({ files }) => keyOf(files))]))
    this.stale = new Set([...this.stale].filter((key) => here.has(key)))
    this.refused = new Map([...this.refused].filter(([key]) => here.has(key)))
    this.reports = this.reports.filter(({ files }) => here.has(keyOf(files)))
  }
  want(keys: readonly string[], wanted: boolean): void {
    const left = new Set(this.left)
    for (const key of keys) {
      if (wanted) left.delete(key)
      else left.add(key)
    }
    this.left = left
  }

  /** For whoever leaves the page: the upload of an import that is over has only what was left out. */
  leave(): void {
    if (!this.busy && this.outcomes.size > 0 && this.wanted.length === 0 && this.reports.some(({ files }) => !this.isStored(keyOf(files)))) this.sender.forget()
  }
  /** Where the window goes, what is not being imported is given up. */
  close(): void {
    if (this.doing?.what === 'import') return
    this.jobs.cancel().catch(() => {})
    this.sender.forget()
  }

  /** Makes the reports anew: of some recordings, or of all. */
  async inspect(keys?: readonly string[]): Promise<void> {
    if (this.doing) return
    this.unsettle()
    this.fault = undefined
    const isSame = this.revisions.mark()
    const groups = keys ? this.groups(this.present(keys)) : [{ keys: [], body: {}, rig: '' }]
    for (const [at, group] of groups.entries()) {
      // What was corrected meanwhile is looked at afterwards.
      const now = group.keys.filter(isSame)
      if (keys && now.length === 0) continue
      this.doing = { what: 'inspect', part: at / groups.length }
      try {
        const inspection = await this.run<Inspection>(
          'inspect',
          { ...group, keys: now },
          (part) => (this.doing = { ...this.doing!, part: (at + part) / groups.length }),
        )
        const errors = this.take(inspection, keys ? now : undefined)
        if (keys) this.looked(now.filter(isSame), errors)
      } catch (fault) {
        if (isCancelled(fault)) return
        if (!keys || !isOfTheCall(fault)) return this.fail(fault, () => void (keys ? this.inspect([...this.stale]) : this.send()))
        this.looked(now.filter(isSame), new Map(now.map((key) => [key, fault])))
      } finally {
        this.doing = undefined
      }
    }
    this.forgetGone()
    if (keys) return
    // What was corrected before files were added holds for them, too.
    const again = this.all !== kNone || this.own.size > 0 ? this.reports.map(({ files }) => keyOf(files)) : []
    this.refused = new Map()
    this.stale = new Set([...[...this.stale].filter((key) => !isSame(key)), ...again])
    if (again.length > 0) await this.inspect(again)
  }
  /** What is told of these recordings is of what they are now: `refused` has what is not taken of it. */
  private looked(keys: readonly string[], refused: ReadonlyMap<string, unknown>): void {
    const over = new Set(keys)
    this.stale = new Set([...this.stale].filter((key) => !over.has(key)))
    this.refused = new Map([...[...this.refused].filter(([key]) => !over.has(key)), ...[...refused].filter(([key]) => over.has(key))])
  }

  /** Stores what is wanted, one call for recordings that are told the same. One that is refused leaves the others. */
  async import(): Promise<void> {
    this.fault = undefined
    this.turnedAway = false
    const isSame = this.revisions.mark()
    const groups = this.groups(this.wanted.map(({ files }) => keyOf(files)).filter((key) => !this.stale.has(key)))
    const count = groups.reduce((sum, { keys }) => sum + keys.length, 0)
    let before = 0
    for (const group of groups) {
      // What is corrected meanwhile is not stored as it was.
      const keys = group.keys.filter(isSame).sort((a, b) => (this.nameOf(a) < this.nameOf(b) ? -1 : 1)),
        done = before
      before += group.keys.length
      if (keys.length === 0) continue
      this.doing = { what: 'import', part: done / count, call: { keys, part: 0 } }
      try {
        await this.run<ImportResult>('import', { ...group, keys }, (part, result) => {
          this.doing = { what: 'import', part: (done + part * keys.length) / count, call: { keys, part } }
          if (result) this.outcome(result, { ...group, keys: keys.filter(isSame) })
        })
      } catch (fault) {
        if (isCancelled(fault)) break
        if (!isOfTheCall(fault)) {
          this.fail(fault, () => void this.import())
          break
        }
        const failed = keys.filter((key) => isSame(key) && !this.isStored(key))
        this.outcomes = new Map([...this.outcomes, ...failed.map((key) => [key, failedBy(fault, this.nameOf(key))] as const)])
      } finally {
        this.doing = undefined
      }
    }
    this.onimported?.()
  }

  /** A piece of a file's motion as an import would store it; `reading` says how the file is to be read. Only while there is an upload. */
  preview(file: string, reading: Readonly<Record<string, unknown>>, signal: AbortSignal): Promise<OpenedMotion> {
    const { api, database, sender } = this
    return wholeMotion((taker) => previewUpload(api, database, sender.upload!, { ...reading, file }, taker, signal))
  }

  private readonly names = $derived(new Map(this.reports.map(({ files, name }) => [keyOf(files), name])))
  nameOf(key: string): string {
    return this.names.get(key) ?? this.stemOf(key)
  }

  private groups(keys: readonly string[]): readonly Group[] {
    const motions = new Map(this.table().map((pair) => [keyOf(pair), pair.motion]))
    return grouped(
      keys.map((key) => ({ key, motion: motions.get(key) ?? null, one: this.own.get(key) })),
      this.all,
    )
  }

  /** Which files belong together, with their signers, as the next call is to have it. */
  private table(): readonly Pair[] {
    const pairs = this.pairs ?? this.reports.map(({ files }): Pair => ({ ...files, signer: '' }))
    return pairs.map((pair) => ({ ...pair, signer: this.own.get(keyOf(pair))?.signer || this.all.signer || pair.signer }))
  }

  private run<Result>(what: 'inspect' | 'import', { keys, body, rig }: Group, told: (part: number, result?: Result) => void): Promise<Result> {
    return this.jobs.run(
      what,
      () => {
        const table = this.table(),
          isTold = this.pairs || table.some(({ signer }) => signer !== '')
        return {
          parameters: keys.length > 0 ? { ...body, recordings: keys.map((key) => this.nameOf(key)) } : body,
          made: { ...(isTold && { pairs: { name: kTable, text: tableOf(table) } }), ...(rig && { rig: { name: 'parts.rig', text: rig } }) },
        }
      },
      told,
    )
  }

  /** A new report takes the place of what was told of the same recordings; gives what is wrong with corrections. */
  private take(inspection: Inspection, keys?: readonly string[]): ReadonlyMap<string, unknown> {
    const { reports: told, errors } = withGood(inspection.recordings, this.reports, (key) => keys !== undefined && (this.own.has(key) || this.all !== kNone))
    const toldKeys = new Set(told.map(({ files }) => keyOf(files)))
    const here = this.pairs && new Set(this.pairs.map(keyOf))
    const rest = keys ? this.reports.filter(({ files }) => !toldKeys.has(keyOf(files)) && (!here || here.has(keyOf(files)))) : []
    this.reports = [...rest, ...told].sort((a, b) => (a.name < b.name ? -1 : 1))
    if (!keys) this.notices = inspection.notices
    this.faults = inspection.faults
    return errors
  }

  private outcome({ recordings }: ImportResult, group: Group): void {
    const outcomes = new Map(this.outcomes),
      keys = new Map(group.keys.map((key) => [this.nameOf(key), key]))
    for (const one of recordings) {
      const key = keys.get(one.name)
      if (key !== undefined) outcomes.set(key, one)
    }
    this.outcomes = outcomes
  }

  private touched(keys: readonly string[]): void {
    // What was stored and is corrected now may be stored again.
    this.outcomes = new Map([...this.outcomes].filter(([key]) => !keys.includes(key)))
    this.revisions.bump(keys)
    // What was not taken may be, beside what the others are now.
    this.stale = new Set([...this.stale, ...this.refused.keys(), ...keys])
    this.settle()
  }
  private settle(): void {
    this.unsettle()
    this.settling = setTimeout(() => {
      this.settling = undefined
      if (this.busy) this.settle()
      else if (this.stale.size > 0) void this.inspect([...this.stale])
    }, kSettle)
  }
  private unsettle(): void {
    clearTimeout(this.settling)
    this.settling = undefined
  }

  private change(list: FileList): void {
    this.list = list
    if (this.pairs) this.pairs = this.extended(this.pairs)
    this.forgetReports()
  }
  /** Pairs for the files that are there now. */
  private extended(pairs: readonly Pair[]): readonly Pair[] {
    const names = new Set(this.list.files.map(({ name }) => name))
    return extended(pairs, names, { motion: this.filesOf('motion'), annotation: this.filesOf('annotation'), face: this.filesOf('face') }, this.stemOf)
  }
  private forgetReports(): void {
    this.reports = this.notices = this.faults = []
    this.stale = new Set()
    this.refused = new Map()
    this.outcomes = new Map()
  }

  /** A table of pairs and a mapping file say what is to be corrected: they are read here, and shown as corrections. */
  private async readTables(): Promise<void> {
    for (const { kind, file } of this.list.files) {
      if (kind === 'rig') this.all = { ...this.all, rig: { ...readRig(await file.text()), ...this.all.rig } }
      if (kind !== 'pairs') continue
      const { pairs, faults } = readTable(await file.text(), new Set(this.list.files.map(({ name }) => name)))
      this.tableFaults = faults
      if (pairs.length > 0) this.pairs = pairs
    }
  }

  readonly stemOf = (name: string): string => stemOf(name, this.formats)
  /** What the format of a file is called. */
  formatOf(name: string): string {
    return endingOf(name, this.formats)?.name ?? ''
  }
}
