import { kMostPlaces, piecePlace, signPlace, type Pause, type Place } from './project'

/** What is wrong with a text, by the key of its words; `at` counts characters from 0, `rest` is what stands there. */
export type UtteranceWrong = 'noClosingQuote' | 'emptyName' | 'pieceOrder' | 'badSuffix' | 'tokenZero' | 'tooLong' | 'tooManyPlaces'
export class UtteranceFault extends Error {
  constructor(
    readonly wrong: UtteranceWrong,
    readonly at: number,
    readonly detail = '',
    readonly rest = '',
  ) {
    super(`${wrong} at ${at}`)
  }
}

/** A word of the text: where it stands, and what it asks for; pauses ask for nothing. */
export interface Word {
  readonly from: number
  readonly to: number
  readonly place?: Place
  readonly pause?: Pause
}

const kBlank = /[ \t-\r]/
const kToken = /^(.+)#(\d{1,15})$/s
const kPiece = /^(.*)@(\d{1,15})\.\.(\d{1,15})$/s
const kMostCharacters = 1_000_000

/** The words of an utterance, as `parse_utterance` of the server reads them. Throws UtteranceFault. */
export function wordsOf(text: string): Word[] {
  if (text.length > kMostCharacters) throw new UtteranceFault('tooLong', 0)
  const words: Word[] = []
  for (let at = 0; at < text.length;) {
    if (kBlank.test(text[at])) {
      ++at
      continue
    }
    const from = at
    let name: string,
      suffix = ''
    const quoted = text[at] === '"'
    if (quoted) {
      const close = text.indexOf('"', at + 1)
      if (close < 0) throw new UtteranceFault('noClosingQuote', at, '', text.slice(at, at + 30))
      name = text.slice(at + 1, close)
      at = close + 1
      while (at < text.length && !kBlank.test(text[at])) suffix += text[at++]
    } else {
      while (at < text.length && !kBlank.test(text[at])) ++at
      name = text.slice(from, at)
      if (name === ',' || name === '.') {
        words.push({ from, to: at, pause: name === ',' ? 'comma' : 'stop' })
        continue
      }
      const split = splitBare(name)
      name = split.name
      suffix = split.suffix
    }
    words.push({ from, to: at, place: placeOf(name, suffix, from) })
  }
  return words
}

/** "MATIN#3" and "meteo@1..2" of a bare word. */
function splitBare(word: string): { name: string; suffix: string } {
  const piece = kPiece.exec(word)
  if (piece && piece[1] !== '') return { name: piece[1], suffix: word.slice(piece[1].length) }
  const token = kToken.exec(word)
  return token ? { name: token[1], suffix: word.slice(token[1].length) } : { name: word, suffix: '' }
}

function placeOf(name: string, suffix: string, at: number): Place {
  if (name.trim() === '') throw new UtteranceFault('emptyName', at, '', `"${name}"${suffix}`)
  if (suffix === '') return signPlace(name)
  const piece = kPiece.exec(suffix)
  if (piece && piece[1] === '') {
    const from = Number(piece[2]),
      to = Number(piece[3])
    if (from >= to) throw new UtteranceFault('pieceOrder', at)
    return piecePlace(name, from, to)
  }
  const token = /^#(\d{1,15})$/.exec(suffix)
  if (!token) throw new UtteranceFault('badSuffix', at, suffix)
  if (Number(token[1]) === 0) throw new UtteranceFault('tokenZero', at, '', name + suffix)
  return signPlace(name, Number(token[1]))
}

/** The places of a text: of several pauses in a row the longest counts, before the first and after the last sign they say nothing. */
export function placesOf(text: string): Place[] {
  const places: Place[] = []
  let pause: Pause = 'none'
  for (const word of wordsOf(text)) {
    if (word.pause) pause = pause === 'stop' ? 'stop' : word.pause
    if (!word.place) continue
    if (places.length === kMostPlaces) throw new UtteranceFault('tooManyPlaces', word.from)
    places.push({ ...word.place, pause: places.length > 0 ? pause : 'none' })
    pause = 'none'
  }
  return places
}

/** A name as it must be typed to come out the same. */
export function quoted(name: string): string {
  const bare = name !== '' && name !== ',' && name !== '.' && !name.startsWith('"') && !/[ \t-\r]/.test(name) && splitBare(name).suffix === ''
  return bare ? name : `"${name}"`
}

/** Whether a name can be typed at all: one that holds a quote and cannot stand bare cannot. */
export function canBeTyped(name: string): boolean {
  return name.trim() !== '' && (quoted(name) === name || !name.includes('"'))
}

/** A place as it is typed, without what stands before it. */
export function wordOf(place: Place): string {
  if (place.kind === 'piece') return `${quoted(place.recording)}@${place.from}..${place.to}`
  return quoted(place.gloss) + (place.token > 0 ? `#${place.token}` : '')
}

/** Text that is read as the same places. */
export function textOf(places: readonly Place[]): string {
  return places.map((place, k) => (k === 0 || place.pause === 'none' ? '' : place.pause === 'comma' ? ', ' : '. ') + wordOf(place)).join(' ')
}
