import type { Gap } from './gaps'
import { Random } from './random'

export const kFluencies = ['deaf', 'hearing', 'learner', 'none'] as const
export type Fluency = (typeof kFluencies)[number]
/** The texts on the screens of a study, so that each study can have its own questions. */
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
  /** Two motions at a time, or one. */
  readonly mode: 'pair' | 'single'
  readonly methods: readonly string[]
  readonly trials: number
  /** The number of additional trials that show the capture twice; for `pair` only. */
  readonly catches: number
  /** Ms on both sides of a gap. */
  readonly around: number
  /** Whether all participants see the trials in one order, or each in a separate order. */
  readonly order: 'own' | 'same'
  /** The questions asked. */
  readonly recorded: boolean
  readonly natural: boolean
  readonly rating: boolean
  readonly comment: boolean
  /** The controls that the viewer may use. */
  readonly speed: boolean
  readonly turn: boolean
  /** The character; null for the plain body. */
  readonly character: string | null
  readonly labels: Labels
}
/** A span of a recording and the gap regenerated in it. Ms of annotation time. */
export interface Item extends Gap {
  readonly recording: string
  readonly begin: number
  readonly end: number
  /** Empty in a catch trial. */ readonly method: string
}
export type Source = Omit<Item, 'method'>
/** `side` is that of the capture; with one motion alone, `left` means that the capture is shown. */
export interface Trial {
  readonly item: number
  readonly side: 'left' | 'right'
}
/** `left` is A, `right` is B; for one motion alone, `left` means "recorded". */
export type Choice = 'left' | 'right'
export interface Answer {
  readonly recorded?: Choice
  readonly natural?: Choice
  readonly rating?: number
  readonly comment: string
  readonly plays: number
  readonly ms: number
  /** The time, as ISO 8601. */ readonly at: string
  /** The version of the program that generated the motion; older studies only have the version at their setup. */
  readonly version?: string
  /** Whether the results had been opened before. */
  readonly unblinded: boolean
}
/** One participant. */
export interface Session {
  readonly participant: string
  readonly fluency: Fluency
  readonly trials: readonly Trial[]
  readonly answers: readonly Answer[]
  readonly draft?: Draft
}
/** An incomplete answer, stored so that a reload loses nothing. */
export type Draft = Partial<Pick<Answer, 'recorded' | 'natural' | 'rating' | 'comment' | 'plays' | 'ms'>>
export interface Study {
  readonly format: typeof kFormat
  readonly database: string
  /** The version of the program that generates the motion. */ readonly version: string
  /** The time of the setup. */ readonly at: string
  readonly settings: Settings
  readonly items: readonly Item[]
  readonly sessions: readonly Session[]
  /** The current participant. */
  readonly current?: string
  readonly unblinded?: string
  /** Fingerprints of the recordings by name, from which `strangersOf` recognises them. */
  readonly recordings?: Readonly<Record<string, string>>
  /** Recordings whose annotation could not be read. */
  readonly leftOut?: readonly string[]
}
export const kFormat = 'signweave study 1'

/** Returns the items, the same for all participants: methods in turn, gaps at random, none repeated with a method before all have been used. */
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

/** Returns the order and the sides for one participant: every method appears equally often on both sides, as far as possible. */
export function trialsOf(items: readonly Item[], { seed, order }: Pick<Settings, 'seed' | 'order'>, participant: string): readonly Trial[] {
  const random = new Random(seed, 'order', order === 'own' ? participant : '')
  let odd = random.below(2)
  const queues = new Map<string, Trial[]>()
  for (const method of new Set(items.map(({ method }) => method))) {
    const mine = items.flatMap((item, i) => (item.method === method ? [i] : []))
    // With an odd number one side has one more: left and right alternate over the methods.
    const left = Math.floor(mine.length / 2) + (mine.length % 2 ? (odd ^= 1) : 0)
    const sides = random.shuffled(mine.map((_, i): Choice => (i < left ? 'left' : 'right')))
    queues.set(
      method,
      random.shuffled(mine).map((item, i) => ({ item, side: sides[i] })),
    )
  }
  const catches = queues.get('') ?? []
  queues.delete('')
  // Blocks that contain each method once, so that fatigue affects all methods alike.
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
/** Whether a question is answered; a comment is optional. */
export function isAnswered(step: Step, draft: Draft): boolean {
  return step === 'comment' || draft[step] !== undefined
}

export const sessionOf = (study: Study) => study.sessions.find(({ participant }) => participant === study.current)
const withSession = (study: Study, session: Session): Study => ({
  ...study,
  sessions: study.sessions.map((one) => (one.participant === session.participant ? session : one)),
})

/** Starts a participant's session, or continues it. */
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
