import { expect, it } from 'vitest'
import { suggested } from '../api/fault'
import { replacements, withoutPlace } from './hints'

it("reads the server's suggestions", () => {
  expect(suggested('no sign has the gloss "VANES"; did you mean VANNES or LE MANS?')).toEqual(['VANNES', 'LE MANS'])
  expect(suggested("no condition is called 'glos'; did you mean gloss?; use one of gloss, phase")).toEqual(['gloss'])
  expect(suggested('no sign has the gloss "X"')).toEqual([])
})

it('replaces the word at the caret', () => {
  expect(replacements('glos = "X"', "query:1:1: no condition is called 'glos'; did you mean gloss?; use", { line: 1, column: 1 })).toEqual([
    { label: 'gloss', text: 'gloss = "X"' },
  ])
})

it('replaces the quoted name in a hint without a position', () => {
  expect(replacements('gloss = VANES & phase = stroke', 'no sign has the gloss "VANES"; did you mean VANNES or NANTES?').map(({ text }) => text)).toEqual([
    'gloss = "VANNES" & phase = stroke',
    'gloss = "NANTES" & phase = stroke',
  ])
  expect(replacements('like("meto"@0..10)', "like(…): no recording 'meto' in this database; did you mean meteo?")).toEqual([
    { label: 'meteo', text: 'like("meteo"@0..10)' },
  ])
  expect(replacements('track(jawOpn) > 0.2', 'track("jawOpn"): no recording of this database has such a scalar track; did you mean jawOpen?')[0].text).toBe(
    'track("jawOpen") > 0.2',
  )
})

it('replaces one of several words, or all of them if a query is suggested', () => {
  expect(replacements('matin vanes', 'nothing is called "vanes"; did you mean VANNES?').map(({ text }) => text)).toEqual(['matin "VANNES"'])
  expect(replacements('Meteo', 'nothing is called "Meteo"; it is a recording: did you mean recording = "meteo"?')).toEqual([
    { label: 'recording = "meteo"', text: 'recording = "meteo"' },
  ])
})

it('suggests nothing if it is unclear what to replace', () => {
  expect(replacements('gloss = "A"', 'no sign has the gloss "B"; did you mean C?')).toEqual([])
  expect(replacements('gloss = "A"', 'the query is empty')).toEqual([])
})

it('removes the position from the message', () => {
  expect(withoutPlace('query:2:10: no phase is called')).toBe('no phase is called')
})
