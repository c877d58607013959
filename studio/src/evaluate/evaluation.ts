import { PageFault } from './fault'

/** One figure, pooled over spans, with its interval; null if there is none, such as the interval for a single recording. */
export interface Estimate {
  readonly value: number | null
  readonly low: number | null
  readonly high: number | null
  /** The sample size. */
  readonly spans: number
  readonly recordings: number
  readonly unit?: string
  readonly over_slerp?: Estimate
  readonly over_hermite?: Estimate
}
export const kHands = ['moving', 'left', 'right'] as const
export type Hand = (typeof kHands)[number]
/** Figures by method and measure name. */
export type Scores = Readonly<Record<string, Readonly<Record<string, Estimate>>>>
export interface Group {
  /** `annotated`, `170 ms`, …; a group with a comma is a part of the one named before the comma. */
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
/** How close a method comes to the captures relative to another: the ratio of their wrist errors, where 1 means equally close. */
export interface Judgement {
  readonly method: string
  readonly over: string
  readonly all: Estimate
  readonly collections: readonly (Estimate & { readonly collection: string })[]
  /** Worse in no collection by more than its interval, and better overall. */
  readonly may_be_default: boolean
}
/** The output of `signweave evaluate --json`, and the answer of the job, which also has the last three fields. */
export interface Evaluation {
  readonly recordings: number
  readonly recordings_left_out: number
  readonly spans_left_out: number
  readonly seed: number
  readonly confidence: number
  /** Missing in files of older versions. */
  readonly judged?: readonly Judgement[]
  readonly tasks: readonly Task[]
  readonly spans: readonly MeasuredSpan[]
  readonly plot?: string
  readonly declarations?: Readonly<Record<string, string>>
  readonly notices?: readonly { readonly where: string; readonly text: string }[]
}

/** Reads output of the command line or of this page. Throws if the text is anything else. */
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
/** Names used as keys in drawings must be unique. */
const areUnique = (names: readonly unknown[]) => names.every(isText) && new Set(names).size === names.length

/** Checks every field that the page uses: an invalid one would break the page during drawing. */
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

/** Returns the figure of a column: `wrist`, or relative to another method, `wrist/slerp`. Undefined if it was not measured. */
export function figureOf(scores: Scores | undefined, method: string, measure: string): Estimate | undefined {
  const [name, over] = measure.split('/')
  const found = scores?.[method]?.[name]
  const figure = over === 'slerp' ? found?.over_slerp : over === 'hermite' ? found?.over_hermite : found
  return typeof figure?.value === 'number' ? figure : undefined
}

/** Returns the groups that are not part of another. */
export function wholeGroups(task: Task): readonly Group[] {
  return task.groups.filter(({ group }) => !group.includes(', '))
}

/** Returns the gap length of a group in ms, if all its gaps have the same length. */
export function gapOf(group: string): number | undefined {
  const found = /^(\d+) ms$/.exec(group)
  return found ? Number(found[1]) : undefined
}

/** Returns the number of spans of each recording, in descending order. */
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
