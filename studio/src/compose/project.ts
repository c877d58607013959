/** The punctuation between a sign and the previous one: nothing, a comma or a full stop. */
export type Pause = 'none' | 'comma' | 'stop'
export const kPauses = ['none', 'comma', 'stop'] as const

/** A junction's own settings; the defaults apply to the rest. */
export interface Join {
  readonly method?: string
  readonly durationMs?: number
  readonly tempo?: number
}

interface Placed {
  /** Identifies a place while it moves; not saved. */
  readonly id: number
  /**
   * The pause before this place; `join` likewise belongs to the junction before it. Both move with the place. For the first place both are stored but have no
   * effect.
   */
  readonly pause: Pause
  readonly join: Join
}
/** A gloss; token 0 means the best match, otherwise tokens are counted from 1 by recording name, then time. */
export interface SignPlace extends Placed {
  readonly kind: 'sign'
  readonly gloss: string
  readonly token: number
}
/** A piece of a recording, in ms of its annotation time. */
export interface PiecePlace extends Placed {
  readonly kind: 'piece'
  readonly recording: string
  readonly from: number
  readonly to: number
}
export type Place = SignPlace | PiecePlace

export const kAligns = ['auto', 'ground', 'none'] as const
/** How the whole is signed; an empty text leaves it to the server. */
export interface How {
  readonly transition: string
  readonly duration: 'fitted' | 'corpus' | number
  readonly tempo: number
  readonly align: (typeof kAligns)[number]
  /** Frames a second, as a number or a fraction. */
  readonly rate: string
}

/** Something to be signed. Immutable, so that every state of it can be stored. */
export interface Project {
  readonly places: readonly Place[]
  /**
   * The utterance as typed, if it gives a part of the signer something of its own. It is then what is signed, and edited as text only: `places` are those of
   * the whole body in it, with their joins.
   */
  readonly text?: string
  readonly how: How
  /** The recording that it was made from. */
  readonly original?: string
}

export const kHow: How = { transition: '', duration: 'fitted', tempo: 1, align: 'auto', rate: '' }
export const kEmpty: Project = { places: [], how: kHow }
/** The range that the server accepts, as its description says. */
export const kTempo = { least: 0.25, most: 4 } as const
export const kLongestMs = 60_000
export const kMostPlaces = 10_000

let ids = 0
/** A new place with default settings. */
export function signPlace(gloss: string, token = 0, pause: Pause = 'none', join: Join = {}): SignPlace {
  return { kind: 'sign', id: ++ids, gloss, token, pause, join }
}
export function piecePlace(recording: string, from: number, to: number, pause: Pause = 'none', join: Join = {}): PiecePlace {
  return { kind: 'piece', id: ++ids, recording, from, to, pause, join }
}

/** Replaces the places; those of the new project are all that is signed. */
export function withPlaces(project: Project, places: readonly Place[]): Project {
  const { text: _, ...rest } = project
  return { ...rest, places }
}
export function inserted(project: Project, at: number, ...more: readonly Place[]): Project {
  const { places } = project
  return withPlaces(project, [...places.slice(0, at), ...more, ...places.slice(at)])
}
export function removed(project: Project, at: number): Project {
  return withPlaces(
    project,
    project.places.filter((_, k) => k !== at),
  )
}
/** Moves the place at `from` to `to`, an index in the new order. */
export function moved(project: Project, from: number, to: number): Project {
  const { places } = project
  const rest = places.filter((_, k) => k !== from)
  const end = Math.min(Math.max(0, to), rest.length)
  return from < 0 || from >= places.length || end === from ? project : withPlaces(project, [...rest.slice(0, end), places[from], ...rest.slice(end)])
}
export function duplicated(project: Project, at: number): Project {
  return inserted(project, at + 1, { ...project.places[at], id: ++ids, pause: 'none', join: {} })
}
export function changed(project: Project, at: number, change: (place: Place) => Place): Project {
  return withPlaces(
    project,
    project.places.map((place, k) => (k === at ? change(place) : place)),
  )
}
/** Replaces the sign at a place; the pause and the join are preserved. */
export function replaced(project: Project, at: number, by: Place): Project {
  return changed(project, at, ({ id, pause, join }) => ({ ...by, id, pause, join }))
}
export function withToken(project: Project, at: number, token: number): Project {
  return changed(project, at, (place) => (place.kind === 'sign' ? { ...place, token } : place))
}
export function withPause(project: Project, at: number, pause: Pause): Project {
  return changed(project, at, (place) => ({ ...place, pause }))
}
/** Changes settings of the junction before a place; undefined resets to the default. */
export function withJoin(project: Project, at: number, change: Join): Project {
  const next = changed(project, at, (place) => {
    const join = Object.fromEntries(Object.entries({ ...place.join, ...change }).filter(([, value]) => value !== undefined))
    return { ...place, join }
  })
  return project.text === undefined ? next : { ...next, text: project.text }
}
export function withHow(project: Project, change: Partial<How>): Project {
  return { ...project, how: { ...project.how, ...change } }
}

export function isPlain({ method, durationMs, tempo }: Join): boolean {
  return method === undefined && durationMs === undefined && tempo === undefined
}
export function sameJoin(a: Join, b: Join): boolean {
  return a.method === b.method && a.durationMs === b.durationMs && a.tempo === b.tempo
}
/** Whether two places specify the same sign. */
export function sameSign(a: Place, b: Place): boolean {
  if (a.kind === 'sign') return b.kind === 'sign' && a.gloss === b.gloss && a.token === b.token
  return b.kind === 'piece' && a.recording === b.recording && a.from === b.from && a.to === b.to
}
export function sameHow(a: How, b: How): boolean {
  return a.transition === b.transition && a.duration === b.duration && a.tempo === b.tempo && a.align === b.align && a.rate === b.rate
}
/** Whether two places are joined alike to their predecessors; always true at the beginning. */
function sameBefore(a: Place, b: Place, k: number): boolean {
  return k === 0 || (a.pause === b.pause && sameJoin(a.join, b.join))
}
/** Whether two projects are the same except for their ids. */
export function sameProject(a: Project, b: Project): boolean {
  return (
    a.original === b.original &&
    a.text === b.text &&
    sameHow(a.how, b.how) &&
    a.places.length === b.places.length &&
    a.places.every((one, k) => sameSign(one, b.places[k]) && sameBefore(one, b.places[k], k))
  )
}
/** Returns the index of the first place that differs in sign, position or join, 0 if only parts differ; the number of places if all is equal. */
export function firstChange(a: Project, b: Project): number {
  if (!sameHow(a.how, b.how)) return 0
  let k = 0
  while (k < a.places.length && k < b.places.length) {
    const one = a.places[k],
      other = b.places[k]
    if (!sameSign(one, other) || !sameBefore(one, other, k)) break
    ++k
  }
  return k === a.places.length && k === b.places.length && a.text !== b.text ? 0 : k
}
