import { StudioFault } from '../api/fault'
import type { UtteranceFault as UtteranceFaultRow, UtterancePlace, UtteranceText } from '../api/schema'
import { piecePlace, signPlace, withPlaces, type Pause, type Place, type Project } from './project'

/** A text that cannot be read as an utterance: the first of its faults. */
export class UtteranceFault extends Error {
  constructor(
    readonly text: string,
    readonly row: UtteranceFaultRow,
  ) {
    super(`${row.code} at ${row.begin}`)
  }
  /** The faulty part of the text, in UTF-16 code units; the server counts characters. */
  get range(): { readonly begin: number; readonly end: number } {
    const characters = [...this.text]
    const begin = characters.slice(0, this.row.begin).join('').length
    return { begin, end: begin + characters.slice(this.row.begin, this.row.end).join('').length }
  }
  /** The text without the fault, if the server knows it. */
  get corrected(): string | undefined {
    return this.row.remedies?.find(({ parameter }) => parameter === 'text')?.value
  }
}

/** The content of a text. */
export interface Reading {
  /** Of the whole body. */ readonly places: readonly Place[]
  /** The text, if it also gives parts of the signer something of their own, or changes signs in space. */ readonly text?: string
  /** The pause after the last place. */ readonly pause: Pause
}
/** Reads the text of an utterance; throws UtteranceFault, or what the call throws. */
export type ReadText = (text: string, signal?: AbortSignal) => Promise<Reading>

const kWithParts: UtteranceFaultRow = {
  // The code of a message of the studio: no server has it.
  code: 'text_with_parts' as UtteranceFaultRow['code'],
  message: 'only signs of the whole body can be typed here',
  line: 1,
  column: 1,
  begin: 0,
  end: 0,
}

/** Reads texts by the server's grammar, which is the only one. */
export function readerOf(ask: (text: string, signal?: AbortSignal) => Promise<UtteranceText>): ReadText {
  return async (text, signal) => {
    if (text.trim() === '') return { places: [], pause: 'none' }
    const { places, pause, faults, holds, non_manuals, loci } = await ask(text, signal)
    if (faults.length > 0) throw new UtteranceFault(text, faults[0])
    const hasParts = (holds ?? non_manuals ?? loci ?? places.find(({ parts, dominant, space }) => parts ?? dominant ?? space)) !== undefined
    return { places: places.map(placeOf), pause: pause ?? 'none', ...(hasParts && { text: text.trim() }) }
  }
}
/** Reads single signs: throws UtteranceFault for a text with parts, of which the places alone would be something else. */
export function wholeBody(read: ReadText): ReadText {
  return async (text, signal) => {
    const reading = await read(text, signal)
    if (reading.text !== undefined) throw new UtteranceFault(text, { ...kWithParts, end: [...text].length })
    return reading
  }
}

function placeOf({ gloss, token, recording, from_ms, to_ms, pause }: UtterancePlace): Place {
  if (recording !== undefined && from_ms !== undefined && to_ms !== undefined) return piecePlace(recording, from_ms, to_ms, pause)
  if (gloss !== undefined) return signPlace(gloss, token, pause)
  throw new StudioFault('badAnswer', 'a place without a gloss')
}

/** A name as it must be typed: quoted if the server would otherwise read something else. */
export function quoted(name: string): string {
  const bare = name !== '' && !/^[,.]$|^"|[ \t-\r[\]{}]|.#\d+$|.@\d+\.\.\d+$/s.test(name)
  return bare ? name : `"${name.replaceAll('"', '""')}"`
}

/** Whether a name can be typed at all: one of blanks cannot. */
export function canBeTyped(name: string): boolean {
  return name.trim() !== ''
}

/** A place as it is typed, without the pause before it. */
export function wordOf(place: Place): string {
  if (place.kind === 'piece') return `${quoted(place.recording)}@${place.from}..${place.to}`
  return quoted(place.gloss) + (place.token > 0 ? `#${place.token}` : '')
}

/** Text that is read as the same project, apart from its joins. */
export function utteranceOf({ places, text }: Project): string {
  return text ?? textOf(places)
}
/** The project with these signed at its end. */
export function appended(project: Project, more: readonly Place[]): Project {
  const next = withPlaces(project, [...project.places, ...more])
  return project.text === undefined ? next : { ...next, text: [project.text, ...more.map(pausedWordOf)].join(' ') }
}

/** Text that is read as the same places. */
export function textOf(places: readonly Place[]): string {
  return places.map((place, k) => (k === 0 ? wordOf(place) : pausedWordOf(place))).join(' ')
}
const pausedWordOf = (place: Place) => (place.pause === 'none' ? '' : place.pause === 'comma' ? ', ' : '. ') + wordOf(place)
