import { addressOf, type WorkState } from '../ui/route'
import { isDuration, isMethod, isTempo, joinTexts, readJoin } from './joins'
import { kAligns, kEmpty, kHow, withJoin, type How, type Project } from './project'
import { utteranceOf, type Reading } from './utterance'

/** Returns a project's state in the address: only what differs from the defaults. */
export function stateOf(project: Project): Record<string, string> {
  const { places, how, original } = project
  const state: Record<string, string> = {}
  if (places.length > 0) state.utterance = utteranceOf(project)
  if (how.transition !== kHow.transition) state.transition = how.transition
  if (how.duration !== kHow.duration) state.duration = String(how.duration)
  if (how.tempo !== kHow.tempo) state.tempo = String(how.tempo)
  if (how.align !== kHow.align) state.align = how.align
  if (how.rate !== kHow.rate) state.rate = how.rate
  const junctions = joinTexts(places)
  if (junctions.length > 0) state.junctions = junctions.join(';')
  if (original !== undefined) state.original = original
  return state
}

/** Returns a link for sharing a project: without other content of the page's address, such as the user's access token. */
export function linkTo(project: Project, database: string, page: string): string {
  const link = new URL(addressOf({ page: 'compose', database, state: stateOf(project) }), page)
  link.search = ''
  return link.href
}

/** The content of an address, and the names of unreadable parameters. */
export interface Read {
  readonly project: Project
  readonly wrong: readonly string[]
}

/** Returns the project in an address. Unreadable parts are left out and named. `reading` is that of its utterance; undefined if that could not be read. */
export function projectOf(state: WorkState, reading: Pick<Reading, 'places' | 'text'> | undefined): Read {
  const wrong: string[] = []
  const read = <T>(name: string, from: (text: string) => T | undefined): T | undefined => {
    if (state[name] === undefined) return undefined
    const value = from(state[name])
    if (value === undefined) wrong.push(name)
    return value
  }
  read('utterance', () => reading)
  const how: How = {
    transition: read('transition', (text) => (isMethod(text) ? text : undefined)) ?? kHow.transition,
    duration: read('duration', readDuration) ?? kHow.duration,
    tempo: read('tempo', (text) => (isTempo(Number(text)) ? Number(text) : undefined)) ?? kHow.tempo,
    align: read('align', (text) => kAligns.find((one) => one === text)) ?? kHow.align,
    rate: read('rate', (text) => (isRate(text) ? text : undefined)) ?? kHow.rate,
  }
  const { places = [], text } = reading ?? {}
  let project: Project = { ...kEmpty, how, original: state.original || undefined, places, ...(text !== undefined && { text }) }
  for (const text of state.junctions?.split(';') ?? []) {
    const one = readJoin(text)
    if (one && one.junction < project.places.length) project = withJoin(project, one.junction, one.join)
    else if (!wrong.includes('junctions')) wrong.push('junctions')
  }
  return { project, wrong }
}

export function readDuration(text: string): How['duration'] | undefined {
  if (text === 'fitted' || text === 'corpus') return text
  return /^\d{1,6}$/.test(text) && isDuration(Number(text)) ? Number(text) : undefined
}
/** `60`, `29.97` or `30000/1001`. */
export const isRate = (text: unknown): text is string => typeof text === 'string' && /^\d{1,7}(\.\d{1,6}|\/\d{1,7})?$/.test(text)
