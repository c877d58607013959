import type { Answered } from '../api/client'
import type { Route, WorkPage } from '../ui/route'

/** The known facts about the user's activity: the current page, what it plays, and which calls were answered since the step began. */
export interface Facts {
  readonly route: Route
  readonly playing: boolean
  readonly speed: number
  readonly selected: boolean
  readonly calls: readonly Answered[]
  /** The number of recordings in the database now, and when the step began. */
  readonly recordings: number
  readonly recordingsBefore: number
}
/** The subject of a path; the texts of its steps name it. */
export interface About {
  readonly database: string
  readonly recording: string
  readonly gloss: string
}
export interface Step {
  readonly id: string
  /** The page on which the step is done. */
  readonly to: (about: About) => Route
  /** Whether the step was done. Undefined if only the user knows. */
  readonly done?: (facts: Facts) => boolean
}
export const kPaths = ['demo', 'own'] as const
export type Path = (typeof kPaths)[number]

const work =
  (page: WorkPage) =>
  ({ database }: About): Route => ({ page, database, state: {} })
const recording = ({ database, recording }: About): Route => (recording ? { page: 'recording', database, recording, at: 0 } : { page: 'recordings', database })
const stateOf = (facts: Facts, page: WorkPage) => (facts.route.page === page && 'state' in facts.route ? facts.route.state : undefined)
const utteranceOf = (facts: Facts) => stateOf(facts, 'compose')?.utterance ?? ''
const called = (facts: Facts, method: string, where: RegExp) => facts.calls.some((call) => call.method === method && where.test(call.where))
/** A file that was generated: the call gives its format. */
const isFile = ({ method, where, body }: Answered) =>
  (method === 'POST' && /\/(sign|edit)$/.test(where) && /"format":"(?!frames"|json")/.test(body)) ||
  (method === 'GET' && /\/motion\?/.test(where) && /[?&]format=(?!frames\b)/.test(where))
const saved = (facts: Facts) => facts.calls.some(isFile)
/** How the address specifies a token and a join. */
const kToken = /#\d|@\d+\.\./

const kDemo: readonly Step[] = [
  { id: 'open', to: recording, done: ({ route }) => route.page === 'recording' },
  { id: 'slow', to: recording, done: ({ route, playing, speed }) => route.page === 'recording' && playing && speed < 1 },
  { id: 'select', to: recording, done: ({ route, selected }) => route.page === 'recording' && selected },
  { id: 'search', to: work('search'), done: (facts) => Boolean(stateOf(facts, 'search')?.q) },
  {
    id: 'grid',
    to: ({ database, gloss }) => ({ page: 'search', database, state: { q: `gloss = "${gloss.replace(/[\\"]/g, '\\$&')}"`, view: 'grid' } }),
    done: (facts) => Boolean(stateOf(facts, 'search')?.q) && stateOf(facts, 'search')?.view === 'grid',
  },
  { id: 'compose', to: work('compose'), done: (facts) => utteranceOf(facts).trim().includes(' ') },
  { id: 'token', to: work('compose'), done: (facts) => kToken.test(utteranceOf(facts)) },
  { id: 'transition', to: work('compose'), done: (facts) => Boolean(stateOf(facts, 'compose')?.transition ?? stateOf(facts, 'compose')?.junctions) },
  { id: 'save', to: work('compose'), done: saved },
  { id: 'evaluate', to: work('evaluate'), done: (facts) => facts.route.page === 'evaluate' && called(facts, 'POST', /\/evaluate$/) },
]

const kOwn: readonly Step[] = [
  { id: 'drop', to: work('import'), done: (facts) => called(facts, 'POST', /\/uploads\/[^/]+\/inspect$/) },
  { id: 'report', to: work('import') },
  { id: 'correct', to: work('import'), done: (facts) => called(facts, 'POST', /\/uploads\/[^/]+\/inspect$/) },
  { id: 'store', to: work('import'), done: ({ recordings, recordingsBefore }) => recordings > recordingsBefore },
  { id: 'openOwn', to: ({ database }) => ({ page: 'recordings', database }), done: ({ route }) => route.page === 'recording' },
  { id: 'find', to: work('search'), done: (facts) => Boolean(stateOf(facts, 'search')?.q) },
  {
    id: 'propose',
    to: ({ database }) => ({ page: 'recordings', database }),
    done: (facts) => facts.route.page === 'phases' && called(facts, 'GET', /\/segment(\?|$)/),
  },
  {
    id: 'check',
    to: ({ database }) => ({ page: 'recordings', database }),
    done: (facts) => facts.route.page === 'phases' && called(facts, 'POST', /\/import$/),
  },
  { id: 'composeOwn', to: work('compose'), done: (facts) => utteranceOf(facts).trim() !== '' },
  { id: 'export', to: work('compose'), done: saved },
]
export const kSteps: Readonly<Record<Path, readonly Step[]>> = { demo: kDemo, own: kOwn }
