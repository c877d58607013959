import type { Api } from '../../api/client'
import type { FileFormat, ImportResult, ImportedReply, InspectResult, InspectedRecording, Notice } from '../../api/schema'
import type { FilePart } from '../../api/types'
import { formats, isWritable, previewUpload } from '../../api/corpus_calls'
import type { OpenedMotion } from '../../motion/source'
import { wholeMotion } from '../../motion/whole_motion'
import { grouped, kNone, readRig, type Corrections, type Group } from './corrections'
import { extensionOf, isRefusal, stemOf } from './file_kinds'
import { added, kNoFiles, sendable, withFolderNames, without, type FileList, type Picked } from './file_list'
import { extended, keyOf, paired, readTable, tableOf, type Pair, type TableFault } from './pairs'
import { failedBy, isCancelled, isOfTheCall, withGood } from './reports'
import { Revisions } from './revisions'
import { isGone, Sender } from './sender.svelte'
import { UploadJobs, type Doing } from './upload_jobs'

const kParts: readonly FilePart[] = ['motion', 'annotation', 'face']
const kTable = 'pairs.csv'
/** The delay in ms from a correction until the report is regenerated, so that several corrections are combined. */
const kSettle = 700

/** One import, from choosing files to the outcome. It outlives the page, so that nothing is lost when the user looks at something else. */
export class ImportSession {
  formats = $state.raw<readonly FileFormat[]>([])
  writable = $state<boolean | undefined>()
  list = $state.raw<FileList>(kNoFiles)
  readonly sender: Sender
  doing = $state.raw<Doing | undefined>()
  /** The last general fault, and how to retry. */
  fault = $state.raw<unknown>()
  retry?: () => void
  /** Files were added or removed while a job was running; the change was rejected. */
  turnedAway = $state(false)
  reports = $state.raw<readonly InspectedRecording[]>([])
  notices = $state.raw<readonly Notice[]>([])
  faults = $state.raw<readonly string[]>([])
  /** The server's message for recordings whose corrections it rejected. */
  refused = $state.raw<ReadonlyMap<string, unknown>>(new Map())
  /** Recordings whose report is older than their corrections. */
  stale = $state.raw<ReadonlySet<string>>(new Set())
  /** How files belong together, if the user specified it. */
  pairs = $state.raw<readonly Pair[] | undefined>()
  tableFaults = $state.raw<readonly TableFault[]>([])
  all = $state.raw<Corrections>(kNone)
  own = $state.raw<ReadonlyMap<string, Corrections>>(new Map())
  /** Recordings that are not to be imported. */
  left = $state.raw<ReadonlySet<string>>(new Set())
  outcomes = $state.raw<ReadonlyMap<string, ImportedReply>>(new Map())
  onimported?: () => void
  /** Files added before the readable formats were known. */
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

  /** Loads the formats that the server can read, and whether the database is writable. */
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

  /** Whether files are being sent, inspected or stored. */
  get busy(): boolean {
    return this.sender.busy || this.doing !== undefined
  }
  /** Recordings that were corrected and whose inspection is neither running nor scheduled. */
  get unlooked(): readonly string[] {
    return this.busy || this.settling !== undefined ? [] : [...this.stale]
  }
  /** Returns the names of the files that can be a part of a recording. */
  filesOf(part: FilePart): readonly string[] {
    return this.list.files.filter(({ kind, clash }) => kind === part && !clash).map(({ name }) => name)
  }
  /** The recordings to import that are not stored yet, except those whose corrections are rejected. */
  get wanted(): readonly InspectedRecording[] {
    return this.reports.filter((one) => {
      const key = keyOf(one.files)
      return !one.error && !this.left.has(key) && !this.isStored(key) && (!this.refused.has(key) || this.stale.has(key))
    })
  }
  private isStored(key: string): boolean {
    const outcome = this.outcomes.get(key)?.outcome
    return outcome !== undefined && outcome !== 'failed'
  }
  /** Files that belong to no recording, if the user specified how files belong together. */
  get unused(): readonly string[] {
    const used = new Set(this.pairs?.flatMap(({ motion, annotation, face }) => [motion, annotation, face]))
    return this.pairs ? kParts.flatMap((part) => this.filesOf(part)).filter((name) => !used.has(name)) : []
  }
  outcomeOf(one: InspectedRecording): ImportedReply | undefined {
    return this.outcomes.get(keyOf(one.files))
  }

  async add(more: readonly Picked[]): Promise<void> {
    if (this.writable === undefined) {
      this.early = [...this.early, ...more]
      return
    }
    if (this.isTurnedAway()) return
    // A completed import is over: more files start another import.
    if (this.outcomes.size > 0 && this.wanted.length === 0) this.clear()
    this.change(added(this.list, more, this.formats))
    await this.readTables()
  }
  /** Removes files. Reports of recordings that contained one are regenerated; the others stay. */
  remove(ids: readonly number[]): void {
    if (this.isTurnedAway()) return
    const gone = this.list.files.filter(({ id }) => ids.includes(id))
    const list = without(this.list, ids, this.formats)
    const isPart = (kind: string) => kParts.some((part) => part === kind)
    // For a companion file or a clashing name it is unknown which reports are affected.
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
  /** A running job refers to the current files, so changes are rejected until it is over. */
  private isTurnedAway(): boolean {
    return (this.turnedAway = this.busy)
  }
  /** Starts again, with nothing. */
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

  /** Sends files not sent yet, and inspects all of them. */
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
  /** Sets another file as a part of a recording; null removes it. */
  pair(key: string, part: FilePart, file: string | null): void {
    const before = this.table()
    const after = paired(before, key, part, file, this.stemOf)
    if (after !== before) this.repair(before, after)
  }
  private repair(before: readonly Pair[], after: readonly Pair[]): void {
    const unchanged = new Set(before.map((one) => JSON.stringify(one))),
      here = new Set(after.map(keyOf))
    this.pairs = after
    const over = this.reports.map(({ files }) => keyOf(files)).filter((key) => !here.has(key))
    this.touched([...over, ...after.filter((one) => !unchanged.has(JSON.stringify(one))).map(keyOf)])
  }
  /** Returns the keys of recordings that still exist in the user's pairs. */
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

  /** Called when the user leaves the page: the upload of a completed import contains only recordings that were left out. */
  leave(): void {
    if (!this.busy && this.outcomes.size > 0 && this.wanted.length === 0 && this.reports.some(({ files }) => !this.isStored(keyOf(files)))) this.sender.forget()
  }
  /** Called when the window closes: everything except a running import is cancelled. */
  close(): void {
    if (this.doing?.what === 'import') return
    this.jobs.cancel().catch(() => {})
    this.sender.forget()
  }

  /** Regenerates the reports of some recordings, or of all. */
  async inspect(keys?: readonly string[]): Promise<void> {
    if (this.doing) return
    this.unsettle()
    this.fault = undefined
    const isSame = this.revisions.mark()
    const groups = keys ? this.groups(this.present(keys)) : [{ keys: [], body: {}, rig: '' }]
    for (const [at, group] of groups.entries()) {
      // Recordings corrected meanwhile are inspected afterwards.
      const now = group.keys.filter(isSame)
      if (keys && now.length === 0) continue
      this.doing = { what: 'inspect', part: at / groups.length }
      try {
        const inspection = await this.run<InspectResult>(
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
    // Corrections made before files were added apply to these, too.
    const again = this.all !== kNone || this.own.size > 0 ? this.reports.map(({ files }) => keyOf(files)) : []
    this.refused = new Map()
    this.stale = new Set([...[...this.stale].filter((key) => !isSame(key)), ...again])
    if (again.length > 0) await this.inspect(again)
  }
  /** Marks the reports of these recordings as up to date; `refused` holds the faults of their corrections. */
  private looked(keys: readonly string[], refused: ReadonlyMap<string, unknown>): void {
    const over = new Set(keys)
    this.stale = new Set([...this.stale].filter((key) => !over.has(key)))
    this.refused = new Map([...[...this.refused].filter(([key]) => !over.has(key)), ...[...refused].filter(([key]) => over.has(key))])
  }

  /** Stores the wanted recordings, one call for all with the same corrections. A refused call does not affect the others. */
  async import(): Promise<void> {
    this.fault = undefined
    this.turnedAway = false
    const isSame = this.revisions.mark()
    const groups = this.groups(this.wanted.map(({ files }) => keyOf(files)).filter((key) => !this.stale.has(key)))
    const count = groups.reduce((sum, { keys }) => sum + keys.length, 0)
    let before = 0
    for (const group of groups) {
      // Recordings corrected meanwhile are not stored in their old state.
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

  /** Returns part of a file's motion as an import would store it; `reading` gives the options for reading the file. Requires an upload. */
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

  /** Returns how files belong together, with their signers, for the next call. */
  private table(): readonly Pair[] {
    const pairs = this.pairs ?? this.reports.map(({ files }): Pair => ({ ...files, signer: '' }))
    return pairs.map((pair) => ({ ...pair, signer: this.own.get(keyOf(pair))?.signer || this.all.signer || pair.signer }))
  }

  private run<Result>(what: 'inspect' | 'import', { keys, body, rig }: Group, onprogress: (part: number, result?: Result) => void): Promise<Result> {
    return this.jobs.run(
      what,
      () => {
        const table = this.table(),
          hasTable = this.pairs || table.some(({ signer }) => signer !== '')
        return {
          parameters: keys.length > 0 ? { ...body, recordings: keys.map((key) => this.nameOf(key)) } : body,
          made: { ...(hasTable && { pairs: { name: kTable, text: tableOf(table) } }), ...(rig && { rig: { name: 'parts.rig', text: rig } }) },
        }
      },
      onprogress,
    )
  }

  /** Replaces previous reports of the same recordings by new ones; returns the faults of corrections. */
  private take(inspection: InspectResult, keys?: readonly string[]): ReadonlyMap<string, unknown> {
    const { reports: updated, errors } = withGood(inspection.recordings, this.reports, (key) => keys !== undefined && (this.own.has(key) || this.all !== kNone))
    const updatedKeys = new Set(updated.map(({ files }) => keyOf(files)))
    const here = this.pairs && new Set(this.pairs.map(keyOf))
    const rest = keys ? this.reports.filter(({ files }) => !updatedKeys.has(keyOf(files)) && (!here || here.has(keyOf(files)))) : []
    this.reports = [...rest, ...updated].sort((a, b) => (a.name < b.name ? -1 : 1))
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
    // A recording that was stored and corrected since can be stored again.
    this.outcomes = new Map([...this.outcomes].filter(([key]) => !keys.includes(key)))
    this.revisions.bump(keys)
    // Recordings that were refused may be accepted now, in combination with the others' changes.
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
  /** Returns the pairs updated for the current files. */
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

  /** Tables of pairs and mapping files specify corrections: they are read here, and shown as corrections. */
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
  /** Returns the name of a file's format. */
  formatOf(name: string): string {
    return extensionOf(name, this.formats)?.name ?? ''
  }
}
