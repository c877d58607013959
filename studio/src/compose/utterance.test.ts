import { expect, it, vi } from 'vitest'
import type { UtteranceFault as UtteranceFaultRow, UtteranceText } from '../api/schema'
import { carried } from './carry'
import { piecePlace, signPlace, withJoin, withPlaces, kEmpty, type Place } from './project'
import { signs } from './test_places'
import { canBeTyped, readerOf, textOf, UtteranceFault, wholeBody, wordOf } from './utterance'

const plain = ({ id: _, ...rest }: Place) => rest

it('makes places of what the server reads', async () => {
  const answer: UtteranceText = {
    places: [
      { gloss: 'MATIN', token: 2, begin: 0, end: 7 },
      { gloss: 'LE MANS', pause: 'comma', begin: 10, end: 19 },
      { recording: 'r', from_ms: 1, to_ms: 20, pause: 'stop', begin: 22, end: 29 },
    ],
    pause: 'comma',
    faults: [],
  }
  const ask = vi.fn(() => Promise.resolve(answer)),
    read = readerOf(ask)
  const { places, pause } = await read('MATIN#2 , "LE MANS" . r@1..20 ,')
  expect(places.map(plain)).toEqual([signPlace('MATIN', 2), signPlace('LE MANS', 0, 'comma'), piecePlace('r', 1, 20, 'stop')].map(plain))
  expect(pause).toBe('comma')
  // An empty text sends no request.
  expect([await read(' \t'), ask.mock.calls.length]).toEqual([{ places: [], pause: 'none' }, 1])
})

it('throws the first fault, at its place in the text', async () => {
  const text = '😀 A "手'
  const fault: UtteranceFaultRow = {
    code: 'open_quote',
    message: 'm',
    line: 1,
    column: 5,
    begin: 4,
    end: 6,
    remedies: [{ parameter: 'text', value: '😀 A "手"' }],
  }
  const thrown = await readerOf(() => Promise.resolve({ places: [], faults: [fault] }))(text).catch((wrong: unknown) => wrong)
  expect(thrown).toBeInstanceOf(UtteranceFault)
  const { range, corrected } = thrown as UtteranceFault
  expect([text.slice(range.begin, range.end), corrected]).toEqual(['"手', '😀 A "手"'])
})

it('tells texts that give parts something of their own, and refuses them where single signs are typed', async () => {
  const place = { gloss: 'A', begin: 0, end: 1 }
  const code = async (answer: Partial<UtteranceText>) =>
    wholeBody(readerOf(() => Promise.resolve({ places: [place], faults: [], ...answer })))('A').then(
      ({ text }) => `read ${text}`,
      (wrong: unknown) => (wrong as UtteranceFault).row.code as string,
    )
  expect(await code({})).toBe('read undefined')
  expect(await code({ holds: [{ hand: 'weak', from: 0, until: 1 }] })).toBe('text_with_parts')
  expect(await code({ non_manuals: [{ kind: 'gaze', what: 'left', first: 0, last: 0, begin_ms: 0, end_ms: 0 }] })).toBe('text_with_parts')
  expect(await code({ places: [{ ...place, dominant: 'left' }] })).toBe('text_with_parts')
  expect(await code({ places: [{ ...place, parts: [{ part: 'weak', places: 1, signs: [{ gloss: 'B' }] }] }] })).toBe('text_with_parts')
  expect(await code({ places: [{ ...place, space: { to: 'left' } }] })).toBe('text_with_parts')
  expect(await code({ loci: [{ name: 'a', is: 'left', from: 0 }] })).toBe('text_with_parts')
  const read = readerOf(() => Promise.resolve({ places: [{ ...place, dominant: 'left' }], faults: [] }))
  expect(await read(' A{dominant left} ')).toMatchObject({ text: 'A{dominant left}', places: [{ gloss: 'A' }] })
})

it('quotes names that would be read as something else', () => {
  const names = ['LE MANS', 'A#3', 'r@1..2', ',', '.', '#BANK', "AUJOURD'HUI", 'A"B', 'É', '#3', '@1..2', 'C#D', 'A=B', '[X]', 'A{b', 'A "B']
  expect(names.map((name) => wordOf(signPlace(name)))).toEqual([
    '"LE MANS"',
    '"A#3"',
    '"r@1..2"',
    '","',
    '"."',
    '#BANK',
    "AUJOURD'HUI",
    'A"B',
    'É',
    '#3',
    '@1..2',
    'C#D',
    'A=B',
    '"[X]"',
    '"A{b"',
    '"A ""B"',
  ])
  expect(textOf([signPlace('A', 2, 'comma'), signPlace('B', 0, 'comma'), piecePlace('LE MANS', 1, 20, 'stop')])).toBe('A#2 , B . "LE MANS"@1..20')
  expect(['A"B', '"A', 'A "B', ' ', ''].map(canBeTyped)).toEqual([true, true, true, false, false])
})

it('preserves the identity and junction of each place when a text is typed again', () => {
  const before = withJoin(withPlaces(kEmpty, signs('A', 'B', 'C', 'D')), 2, { method: 'gap' }).places
  const ids = (...glosses: string[]) => carried(before, signs(...glosses)).map(({ id }) => before.findIndex((one) => one.id === id))
  expect(ids('A', 'B', 'C', 'D')).toEqual([0, 1, 2, 3])
  expect(ids('A', 'X', 'B', 'C', 'D')).toEqual([0, -1, 1, 2, 3])
  expect(ids('A', 'B', 'X', 'D')).toEqual([0, 1, 2, 3]) // a word retyped is the same place
  expect(ids('C', 'D')).toEqual([2, 3])
  expect(ids('X', 'C', 'Y', 'B')).toEqual([-1, 2, -1, -1])
  expect(carried(before, signs('X', 'A', 'B', 'C', 'D'))[3].join).toEqual({ method: 'gap' })
  const paused = [...signs('A', 'B'), signPlace('C', 0, 'comma'), signPlace('D')]
  expect(carried(before, paused)[2]).toMatchObject({ pause: 'comma', join: { method: 'gap' } })
})
