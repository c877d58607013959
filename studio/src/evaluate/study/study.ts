import type { Gap } from './gaps'
import { Random } from './random'

export const kFluencies = ['deaf', 'hearing', 'learner', 'none'] as const
export type Fluency = (typeof kFluencies)[number]
/** What is written on the screens of a study, so that each has its own questions. */
export const kLabels = [
  'intro',
  'recorded',
  'natural',
  'person',
  'machine',
  'rating',
  'low',
  'high',
  'comment',
  'code',
  'fluency',
  ...kFluencies,
  'thanks',
] as const
export type Label = (typeof kLabels)[number]
export type Labels = Readonly<Record<Label, { readonly en: string; readonly fr: string }>>

export interface Settings {
  readonly seed: number
  /** Two at a time, or one. */
  readonly mode: 'pair' | 'single'
  readonly methods: readonly string[]
  readonly trials: number
  /** How many more show the capture twice; of `pair`. */
  readonly catches: number
  /** Ms on both sides of a gap. */
  readonly around: number
  /** Whether everybody sees the trials in one order, or each in an order of their own. */
  readonly order: 'own' | 'same'
  /** What is asked. */
  readonly recorded: boolean
  readonly natural: boolean
  readonly rating: boolean
  readonly comment: boolean
  /** What the viewer may do beside looking. */
  readonly speed: boolean
  readonly turn: boolean
  /** Who signs; none is the drawn body. */
  readonly character: string | null
  readonly labels: Labels
}
/** A stretch of a recording and what is made anew in it. Ms of annotation time. */
export interface Item extends Gap {
  readonly recording: string
  readonly begin: number
  readonly end: number
  /** None in a catch trial. */ readonly method: string
}
export type Source = Omit<Item, 'method'>
/** `side` is the capture's: of one alone `left` where it is the capture that is shown. */
export interface Trial {
  readonly item: number
  readonly side: 'left' | 'right'
}
/** `left` is A, `right` is B; of one alone `left` is what was recorded. */
export type Choice = 'left' | 'right'
export interface Answer {
  readonly recorded?: Choice
  readonly natural?: Choice
  readonly rating?: number
  readonly comment: string
  readonly plays: number
  readonly ms: number
  /** When, as ISO 8601. */ readonly at: string
  /** Of the program that made what was voted on; older studies know only that of the day when they were set up. */
  readonly version?: string
  /** Whether somebody had looked at the results before. */
  readonly unblinded: boolean
}
/** Somebody who takes part. */
export interface Session {
  readonly participant: string
  readonly fluency: Fluency
  readonly trials: readonly Trial[]
  readonly answers: readonly Answer[]
  readonly draft?: Draft
}
/** An answer that is not given yet, so that a reload loses nothing. */
export type Draft = Partial<Pick<Answer, 'recorded' | 'natural' | 'rating' | 'comment' | 'plays' | 'ms'>>
export interface Study {
  readonly format: typeof kFormat
  readonly database: string
  /** Of the program that makes the motion. */ readonly version: string
  /** When it was set up. */ readonly at: string
  readonly settings: Settings
  readonly items: readonly Item[]
  readonly sessions: readonly Session[]
  /** Whose turn it is. */
  readonly current?: string
  readonly unblinded?: string
  /** What the recordings were like that it shows, by their names: `strangersOf` knows them again. */
  readonly recordings?: Readonly<Record<string, string>>
  /** Recordings whose annotation could not be read. */
  readonly leftOut?: readonly string[]
}
export const kFormat = 'signweave study 1'

/** What is shown, the same for everybody: methods in turn, places at random, none twice with a method before all have been. */
export function itemsOf(
  sources: readonly Source[],
  { seed, mode, methods, trials, catches }: Pick<Settings, 'seed' | 'mode' | 'methods' | 'trials' | 'catches'>,
): readonly Item[] {
  if (sources.length === 0 || methods.length === 0) return []
  const random = new Random(seed, 'items')
  let waiting: Source[] = []
  const used = new Map(methods.map((method) => [method, new Set<Source>()]))
  const take = (before: Set<Source>): Source => {
    if (before.size === sources.length) before.clear()
    let at = waiting.findIndex((source) => !before.has(source))
    if (at < 0) at = (waiting = [...waiting, ...random.shuffled(sources)]).findIndex((source) => !before.has(source))
    const [source] = waiting.splice(at, 1)
    before.add(source)
    return source
  }
  const items: Item[] = []
  while (items.length < trials) {
    for (const method of random.shuffled(methods).slice(0, trials - items.length)) items.push({ ...take(used.get(method)!), method })
  }
  const caught = new Set<Source>()
  for (let i = 0; i < (mode === 'pair' ? catches : 0); ++i) items.push({ ...take(caught), method: '' })
  return items
}

/** The order and the sides for one who takes part: every method as often on the left as on the right, as far as it goes. */
export function trialsOf(items: readonly Item[], { seed, order }: Pick<Settings, 'seed' | 'order'>, participant: string): readonly Trial[] {
  const random = new Random(seed, 'order', order === 'own' ? participant : '')
  let odd = random.below(2)
  const queues = new Map<string, Trial[]>()
  for (const method of new Set(items.map(({ method }) => method))) {
    const mine = items.flatMap((item, i) => (item.method === method ? [i] : []))
    // Of an odd number one side has one more: the left and the right in turn over the methods.
    const left = Math.floor(mine.length / 2) + (mine.length % 2 ? (odd ^= 1) : 0)
    const sides = random.shuffled(mine.map((_, i): Choice => (i < left ? 'left' : 'right')))
    queues.set(
      method,
      random.shuffled(mine).map((item, i) => ({ item, side: sides[i] })),
    )
  }
  const catches = queues.get('') ?? []
  queues.delete('')
  // Blocks in which each method comes once, so that nobody is fresh for one and tired for another.
  const trials: Trial[] = []
  while ([...queues.values()].some((queue) => queue.length > 0)) {
    trials.push(...random.shuffled([...queues.values()].filter((queue) => queue.length > 0)).map((queue) => queue.shift()!))
  }
  for (const one of catches) trials.splice(random.below(trials.length + 1), 0, one)
  return trials
}

/** The questions of a study, in the order in which they are asked. */
export type Step = 'recorded' | 'natural' | 'rating' | 'comment'
export function stepsOf({ mode, recorded, natural, rating, comment }: Settings): readonly Step[] {
  const asked: readonly (readonly [Step, boolean])[] = [
    ['recorded', recorded],
    ['natural', natural && mode === 'pair'],
    ['rating', rating],
    ['comment', comment],
  ]
  return asked.flatMap(([step, is]) => (is ? [step] : []))
}
/** Whether a question has its answer; a comment needs none. */
export function isAnswered(step: Step, draft: Draft): boolean {
  return step === 'comment' || draft[step] !== undefined
}

export const sessionOf = (study: Study) => study.sessions.find(({ participant }) => participant === study.current)
const withSession = (study: Study, session: Session): Study => ({
  ...study,
  sessions: study.sessions.map((one) => (one.participant === session.participant ? session : one)),
})

/** Somebody begins, or goes on where they left. */
export function begin(study: Study, participant: string, fluency: Fluency): Study {
  const known = study.sessions.some((one) => one.participant === participant)
  const sessions = known
    ? study.sessions
    : [...study.sessions, { participant, fluency, trials: trialsOf(study.items, study.settings, participant), answers: [] }]
  return { ...study, sessions, current: participant }
}
export function keepDraft(study: Study, draft: Draft): Study {
  const session = sessionOf(study)
  return session ? withSession(study, { ...session, draft }) : study
}
export function vote(study: Study, answer: Omit<Answer, 'unblinded'>): Study {
  const session = sessionOf(study)
  if (!session || session.answers.length >= session.trials.length) return study
  const { draft: _, ...rest } = session
  return withSession(study, { ...rest, answers: [...session.answers, { ...answer, unblinded: study.unblinded !== undefined }] })
}
export function leave({ current: _, ...study }: Study): Study {
  return study
}
