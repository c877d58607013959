import { expect, it } from 'vitest'
import { CsvReader } from './csv'

it('returns each record once it is complete, for any chunking of the text', () => {
  const text = 'recording,name\nmeteo,"A, ""B""\nC"\nvilles,\n"",x\n'
  const wanted = [
    ['recording', 'name'],
    ['meteo', 'A, "B"\nC'],
    ['villes', ''],
    ['', 'x'],
  ]
  for (let cut = 0; cut <= text.length; ++cut) {
    const reader = new CsvReader()
    expect([...reader.push(text.slice(0, cut)), ...reader.push(text.slice(cut))]).toEqual(wanted)
  }
})

it('waits for the end of a line', () => {
  const reader = new CsvReader()
  expect(reader.push('a,b')).toEqual([])
  expect(reader.push(',c\nd')).toEqual([['a', 'b', 'c']])
  expect(reader.push('\n')).toEqual([['d']])
})
