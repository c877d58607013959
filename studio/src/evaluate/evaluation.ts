import { PageFault } from './fault'

/** One figure, pooled over spans, with its interval; null where there is none, as of the interval of one recording alone. */
export interface Estimate {
  readonly value: number | null
  readonly low: number | null
  readonly high: number | null
  /** What it is from. */
  readonly spans: number
  readonly recordings: number
  readonly unit?: string
  readonly over_slerp?: Estimate
  readonly over_hermite?: Estimate
}
export const kHands = ['moving', 'left', 'right'] as const
export type Hand = (typeof kHands)[number]
/** Figures by method and the measure's name. */
export type Scores = Readonly<Record<string, Readonly<Record<string, Estimate>>>>
export interface Group {
  /** `annotated`, `170 ms`, …; those behind a comma are a part of the one before it. */
  readonly group: string
  readonly spans: number
  readonly recordings: number
  readonly hands: Readonly<Partial<Record<Hand, Scores>>>
}
export interface Task {
  readonly task: string
  readonly groups: readonly Group[]
}
export interface MeasuredSpan {
  readonly file: string
  readonly first_frame: number
  readonly frames: number
  readonly group: string
}
/** How near a method comes to the captures beside another: the wrist's error over the other's, where 1 is as near. */
export interface Judgement {
  readonly method: string
  readonly over: string
  readonly all: Estimate
  readonly collections: readonly (Estimate & { readonly collection: string })[]
  /** Worse in no collection by more than its interval, and better over all. */
  readonly may_be_default: boolean
}
/** What `signweave evaluate --json` prints, and what the job answers, which has the last three as well. */
export interface Evaluation {
  readonly recordings: number
  readonly recordings_left_out: number
  readonly spans_left_out: number
  readonly seed: number
  readonly confidence: number
  /** Not in files of older versions. */
  readonly judged?: readonly Judgement[]
  readonly tasks: readonly Task[]
  readonly spans: readonly MeasuredSpan[]
  readonly plot?: string
  readonly declarations?: Readonly<Record<string, string>>
  readonly notices?: readonly { readonly where: string; readonly text: string }[]
}

/** Reads what the command line or this page wrote. Throws where it is something else. */
export function readEvaluation(text: string): Evaluation {
  let read: unknown
  try {
    read = JSON.parse(text)
  } catch {
    throw new PageFault('noEvaluation')
  }
  if (!isEvaluation(read)) throw new PageFault('noEvaluation')
  return read as Evaluation
}

type Fields = Readonly<Record<string, unknown>>
const isObject = (value: unknown): value is Fields => typeof value === 'object' && value !== null && !Array.isArray(value)
const isNumber = (value: unknown) => typeof value === 'number'
const isText = (value: unknown): value is string => typeof value === 'string'
const missing = (value: unknown) => value === undefined || value === null
const every = (of: unknown, is: (value: unknown) => boolean) => isObject(of) && Object.values(of).every(is)
const list = (of: unknown, is: (value: unknown) => boolean): of is readonly Fields[] => Array.isArray(of) && of.every(is)
/** Names that are keys of what is drawn: each there once. */
const areUnique = (names: readonly unknown[]) => names.every(isText) && new Set(names).size === names.length

/** Everything that the page looks at: what is not there as it should be would break it while it is drawn. */
function isEvaluation(read: unknown): boolean {
  return (
    isObject(read) &&
    isNumber(read.recordings) &&
    list(read.tasks, isTask) &&
    areUnique(read.tasks.map(({ task }) => task)) &&
    read.tasks.some(({ groups }) => (groups as readonly unknown[]).length > 0) &&
    list(read.spans, (span) => isObject(span) && isText(span.file) && isText(span.group)) &&
    (missing(read.judged) || (list(read.judged, isJudgement) && areUnique(read.judged.map(({ method }) => method)))) &&
    (missing(read.plot) || isText(read.plot)) &&
    (missing(read.declarations) || every(read.declarations, isText)) &&
    (missing(read.notices) || list(read.notices, (notice) => isObject(notice) && isText(notice.where) && isText(notice.text)))
  )
}
const isTask = (task: unknown) => isObject(task) && isText(task.task) && list(task.groups, isGroup) && areUnique(task.groups.map(({ group }) => group))
const isGroup = (group: unknown) =>
  isObject(group) &&
  isText(group.group) &&
  isNumber(group.spans) &&
  isNumber(group.recordings) &&
  every(group.hands, (scores) => every(scores, (figures) => every(figures, isEstimate)))
const isJudgement = (one: unknown) =>
  isObject(one) &&
  isText(one.method) &&
  isText(one.over) &&
  isEstimate(one.all) &&
  list(one.collections, isEstimate) &&
  areUnique(one.collections.map(({ collection }) => collection))
function isEstimate(figure: unknown): boolean {
  return (
    isObject(figure) &&
    [figure.value, figure.low, figure.high].every((value) => missing(value) || isNumber(value)) &&
    [figure.over_slerp, figure.over_hermite].every((over) => missing(over) || isEstimate(over))
  )
}

/** The figure of a column: `wrist`, or of what it is over, `wrist/slerp`. None where it was not measured. */
export function figureOf(scores: Scores | undefined, method: string, measure: string): Estimate | undefined {
  const [name, over] = measure.split('/')
  const found = scores?.[method]?.[name]
  const figure = over === 'slerp' ? found?.over_slerp : over === 'hermite' ? found?.over_hermite : found
  return typeof figure?.value === 'number' ? figure : undefined
}

/** Groups that are no part of another. */
export function wholeGroups(task: Task): readonly Group[] {
  return task.groups.filter(({ group }) => !group.includes(', '))
}

/** The length of the gaps of a group in ms, where all are as long. */
export function gapOf(group: string): number | undefined {
  const found = /^(\d+) ms$/.exec(group)
  return found ? Number(found[1]) : undefined
}

/** How many spans of each recording there are, the most first. */
export function spansByRecording(
  spans: readonly MeasuredSpan[],
): readonly { readonly recording: string; readonly spans: number; readonly groups: ReadonlyMap<string, number> }[] {
  const by = new Map<string, Map<string, number>>()
  for (const { file, group } of spans) {
    let groups = by.get(file)
    if (!groups) by.set(file, (groups = new Map()))
    groups.set(group, (groups.get(group) ?? 0) + 1)
  }
  return [...by]
    .map(([recording, groups]) => ({ recording, spans: [...groups.values()].reduce((a, b) => a + b, 0), groups }))
    .sort((a, b) => b.spans - a.spans || a.recording.localeCompare(b.recording))
}
