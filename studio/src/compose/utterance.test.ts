import { expect, it } from 'vitest'
import { carried } from './carry'
import { piecePlace, signPlace, withJoin, withPlaces, kEmpty, type Place } from './project'
import { canBeTyped, placesOf, textOf, UtteranceFault, wordsOf } from './utterance'

const plain = ({ id: _, join: __, ...rest }: Place) => rest
const sign = (gloss: string, token = 0, pause = 'none') => ({ kind: 'sign', gloss, token, pause })
const piece = (recording: string, from: number, to: number, pause = 'none') => ({ kind: 'piece', recording, from, to, pause })

it('reads an utterance as the server does', () => {
  expect(placesOf('VANNES MATIN#2 , "LE MANS"').map(plain)).toEqual([sign('VANNES'), sign('MATIN', 2), sign('LE MANS', 0, 'comma')])
  expect(placesOf('"ISL Thanks"@1200..3400 meteo@1..2').map(plain)).toEqual([piece('ISL Thanks', 1200, 3400), piece('meteo', 1, 2)])
  expect(placesOf('. A , . B , C .').map(plain)).toEqual([sign('A'), sign('B', 0, 'stop'), sign('C', 0, 'comma')])
  expect(placesOf(`AUJOURD'HUI #BANK "A#3" "," "LE MANS"#2 A=B C#D #3 @1..2`).map(plain)).toEqual([
    sign("AUJOURD'HUI"),
    sign('#BANK'),
    sign('A#3'),
    sign(','),
    sign('LE MANS', 2),
    sign('A=B'),
    sign('C#D'),
    sign('#3'),
    sign('@1..2'),
  ])
  expect(placesOf('  \t ')).toEqual([])
})

it('says where a text is wrong', () => {
  const wrong = (text: string) => {
    try {
      wordsOf(text)
    } catch (fault) {
      const { wrong, at } = fault as UtteranceFault
      return [wrong, at]
    }
    return undefined
  }
  expect(() => placesOf('A '.repeat(10_001))).toThrow('tooManyPlaces')
  expect(placesOf('A '.repeat(10_000)).length).toBe(10_000)
  expect(['A "B', '"" A', 'A r@5..5', 'A "B"x', 'A#0'].map(wrong)).toEqual([
    ['noClosingQuote', 2],
    ['emptyName', 0],
    ['pieceOrder', 2],
    ['badSuffix', 2],
    ['tokenZero', 0],
  ])
})

it('writes what is read as the same places', () => {
  const names = ['LE MANS', 'A#3', 'r@1..2', ',', '.', '#BANK', "AUJOURD'HUI", 'A"B', 'É', '#3']
  const places = [...names.map((name) => signPlace(name, 2, 'comma')), ...names.map((name) => piecePlace(name, 1, 20, 'stop'))]
  expect(placesOf(textOf(places)).map(plain)).toEqual(places.map(plain).map((one, k) => (k === 0 ? { ...one, pause: 'none' } : one)))
  expect(['A"B', '"A', 'A "B', ' ', ''].map(canBeTyped)).toEqual([true, false, false, false, false])
})

it('keeps, where a text is typed anew, which place is which and how it is joined', () => {
  const before = withJoin(withPlaces(kEmpty, placesOf('A B C D')), 2, { method: 'gap' }).places
  const ids = (text: string) => carried(before, placesOf(text)).map(({ id }) => before.findIndex((one) => one.id === id))
  expect(ids('A B C D')).toEqual([0, 1, 2, 3])
  expect(ids('A X B C D')).toEqual([0, -1, 1, 2, 3])
  expect(ids('A B X D')).toEqual([0, 1, 2, 3]) // a word retyped is the same place
  expect(ids('C D')).toEqual([2, 3])
  expect(ids('X C Y B')).toEqual([-1, 2, -1, -1])
  expect(carried(before, placesOf('X A B C D'))[3].join).toEqual({ method: 'gap' })
  expect(carried(before, placesOf('A B , C D'))[2]).toMatchObject({ pause: 'comma', join: { method: 'gap' } })
})
