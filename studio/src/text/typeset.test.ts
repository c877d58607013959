import { globSync, readFileSync } from 'node:fs'
import { expect, it } from 'vitest'
import { messages as recordings } from '../corpus/recordings/messages'
import { messages as search } from '../search/messages'
import { fr } from './fr'
import { typeset } from './typeset'

it('sets a narrow space where French requires one', () => {
  expect(typeset('Retirer de {name} ? Oui ; non : « rien » !')).toBe('Retirer de {name}\u202f? Oui\u202f; non\u202f: «\u202frien\u202f»\u202f!')
  expect(typeset('sûr : {percent} %')).toBe('sûr\u202f: {percent}\u202f%')
  expect(typeset('gloss =~ /x/, a :b, 12:30')).toBe('gloss =~ /x/, a :b, 12:30')
  expect(typeset({ a: ['x ?'], b: 1, c: null })).toEqual({ a: ['x\u202f?'], b: 1, c: null })
})

it('is applied to every table of French', () => {
  const breaking = (table: object) => Object.values(table).filter((text) => typeof text === 'string' && / [;:!?»](?:$|\s)/.test(text))
  for (const table of [fr, search.fr, recordings.fr]) expect(breaking(table)).toEqual([])
  const tables = globSync('src/**/*messages.ts').filter((file) => /\bfr: \w+ = \{|const fr\b/.test(readFileSync(file, 'utf8')))
  expect(tables.length).toBeGreaterThan(5)
  for (const file of tables) expect(readFileSync(file, 'utf8'), file).toMatch(/typeset\(/)
})
