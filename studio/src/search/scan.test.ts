import { expect, it } from 'vitest'
import { markAt, offsetOf, scan } from './scan'

const kinds = (text: string) => scan(text).map(({ kind, text: value }) => `${kind} ${value}`)

it('splits a query into tokens', () => {
  expect(kinds('gloss = "LE \\"M\\"" & !(tier("A")=~/a\\/b|c/i)')).toEqual([
    'word gloss',
    'symbol =',
    'text LE "M"',
    'symbol &',
    'symbol !',
    'symbol (',
    'word tier',
    'symbol (',
    'text A',
    'symbol )',
    'symbol =~',
    'regex a/b|c',
    'symbol )',
  ])
  expect(kinds("gloss = AUJOURD'HUI ->[100ms..500ms] @ gloss=$X")).toEqual([
    'word gloss',
    'symbol =',
    "word AUJOURD'HUI",
    'symbol ->',
    'gap 100ms..500ms',
    'symbol @',
    'word gloss',
    'symbol =',
    'variable $X',
  ])
  expect(kinds('speed(right_hand) > 1.5 m/s')).toEqual(['word speed', 'symbol (', 'word right_hand', 'symbol )', 'symbol >', 'word 1.5', 'word m', 'word /s'])
  expect(kinds('end(hand).height')).toEqual(['word end', 'symbol (', 'word hand', 'symbol )', 'word .height'])
})

it('reads to the end if something is unfinished', () => {
  expect(scan('gloss = "VAN')[2]).toEqual({ kind: 'text', begin: 8, end: 12, text: 'VAN', closed: false })
  expect(scan('a =~ /x')[2].closed).toBe(false)
  expect(scan('-> [')[1]).toEqual({ kind: 'gap', begin: 3, end: 4, text: '', closed: false })
})

it('converts a line and column, counted in characters', () => {
  expect(offsetOf('glos = "X"', { line: 1, column: 1 })).toBe(0)
  expect(offsetOf('gloss = "😀" &\n phase = strok', { line: 2, column: 10 })).toBe('gloss = "😀" &\n phase = '.length)
  expect(offsetOf('gloss = "😀" & x', { line: 1, column: 15 })).toBe('gloss = "😀" & '.length)
  expect(offsetOf('abc', { line: 1, column: 99 })).toBe(3)
})

it('marks the token at a fault, one letter within it, and nothing after the end', () => {
  expect(markAt('glos = "X"', 0)).toEqual({ begin: 0, end: 4 })
  expect(markAt('glos = "X"', 7)).toEqual({ begin: 7, end: 10 })
  expect(markAt('gloss = "X', 8)).toEqual({ begin: 8, end: 9 })
  expect(markAt('gloss =~ /(/', 10)).toEqual({ begin: 10, end: 11 })
  expect(markAt('gloss = ', 8)).toEqual({ begin: 8, end: 8 })
})
