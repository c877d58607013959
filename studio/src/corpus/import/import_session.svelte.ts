import type { Api } from '../../api/client'
import type { FilePart, FormatRow, Imported, ImportResult, Inspected, Inspection, Notice } from '../../api/corpus_answers'
import { beginUpload, cancelJob, formats, isWritable } from '../../api/corpus_calls'
import { ApiError } from '../../api/fault'
import { grouped, kNone, readRig, type Corrections, type Group } from './corrections'
import { endingOf, isRefusal, stemOf } from './file_kinds'
import { added, kNoFiles, sendable, withFolderNames, without, type FileList, type Picked } from './file_list'
import { extended, keyOf, paired, readTable, tableOf, type Pair, type TableFault } from './pairs'
import { isGone, Sender } from './sender.svelte'

const kParts: readonly FilePart[] = ['motion', 'annotation', 'face']
const kTable = 'pairs.csv'
/** After a correction, ms until the report is made anew: several go together. */
const kSettle = 700

/** What is being done, `part` of it being over, 0 to 1. */
export interface Doing {
  readonly what: 'inspect' | 'import'
  readonly part: number
  /** Of an import, the recordings of the call in their order, and how far it is. */
  readonly call?: { readonly keys: readonly string[]; readonly part: number }
}

/** One import from choosing files to what became of them. It outlives the page, so that nothing is lost where somebody looks at something else. */
export class ImportSession {
  formats = $state.raw<readonly FormatRow[]>([])
  writable = $state<boolean | undefined>()
  list = $state.raw<FileList>(kNoFiles)
  readonly sender: Sender
  doing = $state.raw<Doing | undefined>()
  /** What went wrong last with all of it. */
  fault = $state.raw<unknown>()
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
  private job?: string
  private settling?: ReturnType<typeof setTimeout>

  constructor(private readonly api: Api, private readonly database: string) {
    this.sender = new Sender(api, database)
    void this.begin()
  }

  /** Asks what the server can read, and whether it may be given anything. */
  async begin(): Promise<void> {
    this.fault = undefined
    try {
      ;[this.formats, this.writable] = await Promise.all([formats(this.api), isWritable(this.api, this.database)])
    } catch (fault) {
      this.fault = fault
    }
  }

  /** The names of the files that can be a part of a recording. */
  filesOf(part: FilePart): readonly string[] {
    return this.list.files.filter(({ kind, clash }) => kind === part && !clash).map(({ name }) => name)
  }
  /** The recordings that are to be imported and are not there yet. */
  get wanted(): readonly Inspected[] {
    return this.reports.filter((one) => {
      const outcome = this.outcomeOf(one)?.outcome
      return !one.error && !this.left.has(keyOf(one.files)) && (outcome === undefined || outcome === 'failed')
    })
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
    // What was stored is over: more files are another import.
    if (this.outcomes.size > 0 && this.wanted.length === 0) this.clear()
    this.change(added(this.list, more, this.formats))
    await this.readTables()
  }
  /** Takes files out. Reports of recordings that had one are made anew, the others stay. */
  remove(ids: readonly number[]): void {
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
    this.change(withFolderNames(this.list, this.formats))
  }
  /** Begins anew, without anything. */
  clear(): void {
    clearTimeout(this.settling)
    this.sender.forget()
    this.list = kNoFiles
    this.forgetReports()
    this.all = kNone
    this.own = new Map()
    this.left = new Set()
    this.tableFaults = []
    this.pairs = undefined
    this.fault = undefined
  }

  /** Sends what was not sent, and looks at all of it. */
  async send(again = false): Promise<void> {
    this.fault = undefined
    const files = sendable(this.list)
    try {
      if (await this.sender.send(files)) await this.inspect()
    } catch (fault) {
      if (isGone(fault) && !again) {
        this.sender.forget()
        return this.send(true)
      }
      this.fault = fault
    }
  }

  cancel(): void {
    this.sender.cancel()
    if (this.job) cancelJob(this.api, this.job).catch((fault: unknown) => (this.fault = fault))
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
    const told = new Set(before.map((one) => JSON.stringify(one))), here = new Set(after.map(keyOf))
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
  want(keys: readonly string[], wanted: boolean): void {
    const left = new Set(this.left)
    for (const key of keys) wanted ? left.delete(key) : left.add(key)
    this.left = left
  }

  /** Makes the reports anew: of some recordings, or of all. */
  async inspect(keys?: readonly string[]): Promise<void> {
    clearTimeout(this.settling)
    if (this.doing) return
    this.fault = undefined
    const refused = new Map(this.refused), stale = new Set(this.stale)
    const corrected = this.all !== kNone || this.own.size > 0
    const groups = keys ? this.groups(this.present(keys)) : [{ keys: [], body: {}, rig: '' }]
    for (const [at, group] of groups.entries()) {
      this.doing = { what: 'inspect', part: at / groups.length }
      try {
        const inspection = await this.run<Inspection>('inspect', group, (part) => (this.doing = { ...this.doing!, part: (at + part) / groups.length }))
        this.take(inspection, keys ? group.keys : undefined)
        for (const key of group.keys) refused.delete(key), stale.delete(key)
        if (!keys) refused.clear(), stale.clear()
      } catch (fault) {
        if (isCancelled(fault)) break
        if (!keys) {
          this.fault = fault
          break
        }
        for (const key of group.keys) refused.set(key, fault), stale.delete(key)
      } finally {
        this.doing = undefined
      }
    }
    this.refused = refused
    this.stale = new Set(this.present(stale))
    const there = new Set(this.present(this.reports.map(({ files }) => keyOf(files))))
    this.reports = this.reports.filter(({ files }) => there.has(keyOf(files)))
    // What was corrected before files were added holds for them, too.
    if (!keys && corrected && !this.fault && this.reports.length > 0) await this.inspect(this.reports.map(({ files }) => keyOf(files)))
  }

  /** Stores what is wanted, one call for recordings that are told the same. */
  async import(): Promise<void> {
    this.fault = undefined
    const groups = this.groups(this.wanted.map(({ files }) => keyOf(files)))
    const count = groups.reduce((sum, { keys }) => sum + keys.length, 0)
    let before = 0
    for (const group of groups) {
      const keys = [...group.keys].sort((a, b) => (this.nameOf(a) < this.nameOf(b) ? -1 : 1)), done = before
      this.doing = { what: 'import', part: done / count, call: { keys, part: 0 } }
      try {
        await this.run<ImportResult>('import', group, (part, result) => {
          this.doing = { what: 'import', part: (done + part * keys.length) / count, call: { keys, part } }
          if (result) this.outcome(result, group)
        })
      } catch (fault) {
        if (!isCancelled(fault)) this.fault = fault
        break
      } finally {
        this.doing = undefined
      }
      before += group.keys.length
    }
    this.onimported?.()
  }

  private readonly names = $derived(new Map(this.reports.map(({ files, name }) => [keyOf(files), name])))
  nameOf(key: string): string {
    return this.names.get(key) ?? this.stemOf(key)
  }

  private groups(keys: readonly string[]): readonly Group[] {
    const motions = new Map(this.table().map((pair) => [keyOf(pair), pair.motion]))
    return grouped(keys.map((key) => ({ key, motion: motions.get(key) ?? null, one: this.own.get(key) })), this.all)
  }

  /** Which files belong together, with their signers, as the next call is to have it. */
  private table(): readonly Pair[] {
    const pairs = this.pairs ?? this.reports.map(({ files }): Pair => ({ ...files, signer: '' }))
    return pairs.map((pair) => ({ ...pair, signer: this.own.get(keyOf(pair))?.signer || this.all.signer || pair.signer }))
  }

  /** Does a call of an upload; where the server has the upload no more, everything is sent again first. */
  private async run<Result>(what: 'inspect' | 'import', group: Group, told: (part: number, result?: Result) => void): Promise<Result> {
    try {
      return await this.once(what, group, told)
    } catch (fault) {
      if (!isGone(fault)) throw fault
      this.sender.forget()
      if (!(await this.sender.send(sendable(this.list)))) throw fault
      return this.once(what, group, told)
    }
  }

  private async once<Result>(what: 'inspect' | 'import', { keys, body, rig }: Group, told: (part: number, result?: Result) => void): Promise<Result> {
    const { api, database, sender } = this
    await sender.retract(sendable(this.list))
    const table = this.table()
    const parameters: Record<string, unknown> = { ...body }
    if (this.pairs || table.some(({ signer }) => signer !== '')) {
      parameters.pairs = kTable
      await sender.put(kTable, tableOf(table))
    }
    if (rig) {
      parameters.rig = 'parts.rig'
      await sender.put('parts.rig', rig)
    }
    if (keys.length > 0) parameters.recordings = keys.map((key) => this.nameOf(key))
    const begun = await beginUpload(api, database, sender.upload!, what, parameters)
    this.job = begun.job
    try {
      const result = await api.result<Result>(begun, (state) => told(state.fraction, state.result))
      told(1, result)
      return result
    } finally {
      this.job = undefined
    }
  }

  /** A new report takes the place of what was told of the same recordings. */
  private take(inspection: Inspection, keys?: readonly string[]): void {
    const told = inspection.recordings, toldKeys = new Set(told.map(({ files }) => keyOf(files)))
    const here = this.pairs && new Set(this.pairs.map(keyOf))
    const rest = keys ? this.reports.filter(({ files }) => !toldKeys.has(keyOf(files)) && (!here || here.has(keyOf(files)))) : []
    this.reports = [...rest, ...told].sort((a, b) => (a.name < b.name ? -1 : 1))
    if (!keys) this.notices = inspection.notices
    this.faults = inspection.faults
  }

  private outcome({ recordings }: ImportResult, group: Group): void {
    const outcomes = new Map(this.outcomes), keys = new Map(group.keys.map((key) => [this.nameOf(key), key]))
    for (const one of recordings) {
      const key = keys.get(one.name)
      if (key !== undefined) outcomes.set(key, one)
    }
    this.outcomes = outcomes
  }

  private touched(keys: readonly string[]): void {
    // What was stored and is corrected now may be stored again.
    this.outcomes = new Map([...this.outcomes].filter(([key]) => !keys.includes(key)))
    this.stale = new Set([...this.stale, ...keys])
    this.settle()
  }
  private settle(): void {
    clearTimeout(this.settling)
    this.settling = setTimeout(() => {
      if (this.doing || this.sender.busy) this.settle()
      else if (this.stale.size > 0 && this.sender.upload) void this.inspect([...this.stale])
    }, kSettle)
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

const isCancelled = (fault: unknown) => fault instanceof ApiError && fault.code === 'cancelled'

const sessions = new Map<string, ImportSession>()
/** The import that goes on for a database, also where its page was left. */
export function sessionOf(api: Api, database: string): ImportSession {
  let session = sessions.get(database)
  if (!session) sessions.set(database, (session = new ImportSession(api, database)))
  return session
}
