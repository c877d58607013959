import { isDuration, isMethod, isTempo } from './joins'
import { kAligns, kHow, kMostPlaces, kPauses, piecePlace, signPlace, type How, type Join, type Pause, type Place, type Project } from './project'
import { isRate } from './state'
import { canBeTyped } from './utterance'

/** The newest version of the files that this studio reads and writes; version 2 has texts with parts. */
const kVersion = 2
const kName = 'signweave compose'

/** The faults of a project file, named by the key of their message; `detail` gives the position or the field. */
export type FileWrong = 'notJson' | 'notProject' | 'newerVersion' | 'unknownField' | 'badValue' | 'tooManyPlaces'
export class FileFault extends Error {
  constructor(
    readonly wrong: FileWrong,
    readonly detail = '',
  ) {
    super(`${wrong} ${detail}`)
  }
}

/** Writes a project as a file, formatted for people to read. */
export function fileOf({ places, text, how, original }: Project, database: string): string {
  return (
    JSON.stringify(
      {
        project: kName,
        // Studios of version 1 would sign the places alone.
        version: text === undefined ? 1 : kVersion,
        database,
        original,
        utterance: text,
        settings: { transition: how.transition || undefined, duration: how.duration, tempo: how.tempo, align: how.align, rate: how.rate || undefined },
        places: places.map((place, k) => placeRow(k === 0 ? bare(place) : place)),
      },
      null,
      2,
    ) + '\n'
  )
}

/** Before the first place there is neither pause nor junction. */
const bare = (place: Place): Place => ({ ...place, pause: 'none', join: {} })

function placeRow(place: Place): object {
  const { method, durationMs, tempo } = place.join
  const junction = { method, duration_ms: durationMs, tempo }
  return {
    ...(place.kind === 'sign' ? { gloss: place.gloss, token: place.token || undefined } : { recording: place.recording, from_ms: place.from, to_ms: place.to }),
    pause: place.pause === 'none' ? undefined : place.pause,
    junction: Object.values(junction).some((value) => value !== undefined) ? junction : undefined,
  }
}

export interface FileRead {
  readonly project: Project
  /** The database in which it was made, which may not be the current one. */ readonly database?: string
}

/** Reads a project file. Throws FileFault, also for a field that this version does not know, because it would be lost. */
export function readFile(text: string): FileRead {
  let given: unknown
  try {
    given = JSON.parse(text)
  } catch {
    throw new FileFault('notJson')
  }
  if (!isRecord(given) || given.project !== kName) throw new FileFault('notProject')
  if (typeof given.version === 'number' && given.version > kVersion) throw new FileFault('newerVersion', String(given.version))
  if (given.version !== 1 && given.version !== 2) throw new FileFault('badValue', 'version')
  const whole = fields(given, '', ['project', 'version', 'database', 'original', 'settings', 'places', ...(given.version > 1 ? ['utterance'] : [])])
  const settings = whole.settings === undefined ? {} : recordAt(whole.settings, 'settings')
  const places = whole.places
  if (!Array.isArray(places)) throw new FileFault('badValue', 'places')
  if (places.length > kMostPlaces) throw new FileFault('tooManyPlaces', String(places.length))
  const project: Project = {
    places: [],
    how: howOf(fields(settings, 'settings.', ['transition', 'duration', 'tempo', 'align', 'rate'])),
    original: optional(whole.original, 'original', isText),
  }
  const typed = optional(whole.utterance, 'utterance', isText)
  return {
    project: { ...project, places: places.map(readPlace), ...(typed !== undefined && { text: typed }) },
    database: optional(whole.database, 'database', isText),
  }
}

function howOf({ transition, duration, tempo, align, rate }: Record<string, unknown>): How {
  const isLength = (value: unknown): value is How['duration'] => value === 'fitted' || value === 'corpus' || isDuration(value)
  const isAlign = (value: unknown): value is How['align'] => kAligns.some((one) => one === value)
  return {
    transition: optional(transition, 'settings.transition', isMethod) ?? kHow.transition,
    duration: optional(duration, 'settings.duration', isLength) ?? kHow.duration,
    tempo: optional(tempo, 'settings.tempo', isTempo) ?? kHow.tempo,
    align: optional(align, 'settings.align', isAlign) ?? kHow.align,
    rate: optional(rate, 'settings.rate', isRate) ?? kHow.rate,
  }
}

function readPlace(row: unknown, k: number): Place {
  const place = placeOf(row, `places[${k}]`)
  return k === 0 ? bare(place) : place
}
function placeOf(given: unknown, where: string): Place {
  const row = recordAt(given, where)
  const isPause = (value: unknown): value is Pause => kPauses.some((one) => one === value)
  const pause = optional(row.pause, `${where}.pause`, isPause) ?? 'none'
  const join = row.junction === undefined ? {} : joinOf(recordAt(row.junction, `${where}.junction`), `${where}.junction.`)
  if ('recording' in row) {
    const { recording, from_ms, to_ms } = fields(row, `${where}.`, ['recording', 'from_ms', 'to_ms', 'pause', 'junction'])
    const name = needed(recording, `${where}.recording`, isName),
      from = needed(from_ms, `${where}.from_ms`, isMs)
    return piecePlace(
      name,
      from,
      needed(to_ms, `${where}.to_ms`, (value): value is number => isMs(value) && value > from),
      pause,
      join,
    )
  }
  const { gloss, token } = fields(row, `${where}.`, ['gloss', 'token', 'pause', 'junction'])
  return signPlace(needed(gloss, `${where}.gloss`, isName), optional(token, `${where}.token`, isMs) ?? 0, pause, join)
}

function joinOf(row: Record<string, unknown>, where: string): Join {
  const { method, duration_ms, tempo } = fields(row, where, ['method', 'duration_ms', 'tempo'])
  const join = {
    method: optional(method, `${where}method`, isMethod),
    durationMs: optional(duration_ms, `${where}duration_ms`, isDuration),
    tempo: optional(tempo, `${where}tempo`, isTempo),
  }
  return Object.fromEntries(Object.entries(join).filter(([, value]) => value !== undefined))
}

const isRecord = (value: unknown): value is Record<string, unknown> => typeof value === 'object' && value !== null && !Array.isArray(value)
const isText = (value: unknown): value is string => typeof value === 'string' && value !== ''
const isName = (value: unknown): value is string => typeof value === 'string' && canBeTyped(value)
const isMs = (value: unknown): value is number => Number.isSafeInteger(value) && (value as number) >= 0

function recordAt(value: unknown, where: string): Record<string, unknown> {
  if (!isRecord(value)) throw new FileFault('badValue', where)
  return value
}
function fields(row: Record<string, unknown>, where: string, known: readonly string[]): Record<string, unknown> {
  const unknown = Object.keys(row).find((name) => !known.includes(name))
  if (unknown !== undefined) throw new FileFault('unknownField', where + unknown)
  return row
}
function needed<T>(value: unknown, where: string, is: (value: unknown) => value is T): T {
  if (!is(value)) throw new FileFault('badValue', where)
  return value
}
function optional<T>(value: unknown, where: string, is: (value: unknown) => value is T): T | undefined {
  return value === undefined ? undefined : needed(value, where, is)
}
