import { sessionOf, stepsOf, type Choice, type Fluency, type Session, type Study } from './study'

export const kColumns = [
  'study_seed',
  'trial',
  'participant',
  'fluency',
  'recording',
  'from_ms',
  'to_ms',
  'method',
  'side_of_capture',
  'answer',
  'correct',
  'rating',
  'plays',
  'response_ms',
  'time',
  'software_version',
  'comment',
  'question',
  'kind',
  'signs',
  'shown_from_ms',
  'shown_to_ms',
  'database',
  'character',
  'after_unblinding',
] as const
type Cell = string | number | undefined

/** One question of one trial. */
export interface Vote {
  readonly session: Session
  readonly trial: number
  readonly question: 'recorded' | 'natural' | 'rating'
  /** The method of the trial; empty for a catch trial. */
  readonly method: string
  /** The motion that was judged: the method, or `captured` if the capture was shown alone. */
  readonly judged: string
  readonly choice?: Choice
  /** Whether the capture was identified; undefined for catch trials and for ratings of a single motion. */ readonly correct?: boolean
  readonly rating?: number
  readonly ms: number
}

export function votesOf(study: Study): readonly Vote[] {
  const steps = stepsOf(study.settings)
  const questions = steps.filter((step) => step === 'recorded' || step === 'natural')
  return study.sessions.flatMap((session) =>
    session.answers.flatMap((answer, trial) => {
      const { item, side } = session.trials[trial],
        { method } = study.items[item]
      return (questions.length > 0 ? questions : ['rating' as const]).map((question): Vote => {
        const choice = question === 'rating' ? undefined : answer[question]
        const judged = study.settings.mode === 'single' && side === 'left' ? 'captured' : method
        // With two motions: the capture was chosen; with one: it was identified correctly, where left means "recorded".
        return {
          session,
          trial,
          question,
          method,
          judged,
          choice,
          correct: choice && method ? choice === side : undefined,
          rating: answer.rating,
          ms: answer.ms,
        }
      })
    }),
  )
}

const answerName = (study: Study, choice: Choice | undefined): string =>
  choice === undefined ? '' : study.settings.mode === 'single' ? (choice === 'left' ? 'recorded' : 'made') : choice === 'left' ? 'A' : 'B'
const sideName = (study: Study, side: Choice, method: string): string =>
  !method ? 'both' : study.settings.mode === 'single' ? (side === 'left' ? 'only' : 'none') : side === 'left' ? 'A' : 'B'

/** Returns the rows for `csvOf`: one per vote. */
export function voteRows(study: Study): readonly (readonly Cell[])[] {
  return [
    kColumns,
    ...votesOf(study).map(({ session, trial, question, method, choice, correct, rating, ms }): readonly Cell[] => {
      const { item, side } = session.trials[trial],
        one = study.items[item],
        answer = session.answers[trial]
      return [
        study.settings.seed,
        trial + 1,
        session.participant,
        session.fluency,
        one.recording,
        one.from,
        one.to,
        method || 'captured',
        sideName(study, side, method),
        answerName(study, choice),
        correct === undefined ? '' : Number(correct),
        rating,
        answer.plays,
        ms,
        answer.at,
        answer.version ?? study.version,
        answer.comment,
        question,
        !method ? 'catch' : study.settings.mode,
        one.signs,
        one.begin,
        one.end,
        study.database,
        study.settings.character ?? 'drawn',
        Number(answer.unblinded),
      ]
    }),
  ]
}

/** A proportion with its 95 % confidence interval (Wilson 1927); undefined for an empty sample. */
export interface Share {
  readonly right: number
  readonly of: number
  readonly value: number
  readonly low: number
  readonly high: number
}
export function wilson(right: number, of: number, z = 1.959963984540054): Share | undefined {
  if (of === 0) return undefined
  const p = right / of,
    zz = (z * z) / of
  const middle = p + zz / 2,
    half = z * Math.sqrt((p * (1 - p)) / of + zz / (4 * of)),
    whole = 1 + zz
  return { right, of, value: p, low: right === 0 ? 0 : (middle - half) / whole, high: right === of ? 1 : (middle + half) / whole }
}

/** The result for one method and question. */
export interface Outcome {
  /** Or `captured`, if one motion is shown alone; empty for catch trials. */ readonly method: string
  readonly question: Vote['question']
  readonly share?: Share
  readonly rating?: number
  readonly medianMs: number
  readonly votes: number
}

/**
 * Returns the results for each question and method, of all participants or of those of one fluency. Catch trials have no method: their proportion is that of A.
 */
export function outcomes(study: Study, fluency?: Fluency): readonly Outcome[] {
  const by = new Map<string, Vote[]>()
  for (const one of votesOf(study)) {
    if (fluency && one.session.fluency !== fluency) continue
    const key = `${one.question}\n${one.judged}`
    const list = by.get(key)
    if (list) list.push(one)
    else by.set(key, [one])
  }
  return [...by.values()]
    .map((votes): Outcome => {
      const [{ judged: method, question }] = votes
      const ratings = votes.flatMap(({ rating }) => (rating === undefined ? [] : [rating]))
      const answered = votes.filter(({ choice }) => choice !== undefined)
      return {
        method,
        question,
        votes: votes.length,
        medianMs: median(votes.map(({ ms }) => ms)),
        share: wilson(answered.filter(({ correct, choice }) => (method ? correct : choice === 'left')).length, answered.length),
        rating: ratings.length > 0 ? ratings.reduce((a, b) => a + b, 0) / ratings.length : undefined,
      }
    })
    .toSorted((a, b) => a.question.localeCompare(b.question) || Number(!a.method) - Number(!b.method) || a.method.localeCompare(b.method))
}

function median(values: readonly number[]): number {
  const list = values.toSorted((a, b) => a - b),
    half = list.length >> 1
  return list.length === 0 ? 0 : list.length % 2 ? list[half] : (list[half - 1] + list[half]) / 2
}

export const isOver = (study: Study) => {
  const session = sessionOf(study)
  return session !== undefined && session.answers.length >= session.trials.length
}
