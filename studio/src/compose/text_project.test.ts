import { expect, it } from 'vitest'
import { byMethod, bodyOf, pinned } from './body'
import { Composition } from './composition.svelte'
import { isInBrackets } from './complete'
import { fileOf, readFile } from './file'
import { titleOf } from './making.svelte'
import { firstChange, kEmpty, sameProject, signPlace, withHow, withJoin, withPlaces, withToken, type Project } from './project'
import { projectOf, stateOf } from './state'
import { signs } from './test_places'
import { appended } from './utterance'

const kText = 'A{weak hold ..B} B'
const kHeld: Project = { ...withPlaces(kEmpty, signs('A', 'B')), text: kText }

it('signs the text, not the places that its body has', () => {
  expect([bodyOf(kHeld), stateOf(kHeld), titleOf(kHeld)]).toEqual([{ utterance: kText }, { utterance: kText }, kText])
  const joined = withHow(withJoin(kHeld, 1, { method: 'gap', tempo: 2 }), { tempo: 1.5 })
  expect(bodyOf(joined)).toEqual({ utterance: kText, tempo: 1.5, junctions: ['1=gap,x2'] })
  expect(bodyOf(pinned(byMethod(joined, 'sine'), [3, 4]))).toEqual({ utterance: kText, transition: 'sine', tempo: 1.5, junctions: ['1=x2'] })
})

it('is unchanged by an address and by a file, which earlier studios refuse', () => {
  expect(sameProject(projectOf(stateOf(kHeld), kHeld).project, kHeld)).toBe(true)
  const file = fileOf(withJoin(kHeld, 1, { method: 'gap' }), 'demo')
  expect([sameProject(readFile(file).project, withJoin(kHeld, 1, { method: 'gap' })), (JSON.parse(file) as { version: number }).version]).toEqual([true, 2])
  expect((JSON.parse(fileOf(withPlaces(kEmpty, signs('A')), 'demo')) as { version: number }).version).toBe(1)
  expect(() => readFile(file.replace('"version": 2', '"version": 1'))).toThrow('unknownField utterance')
})

it('tells texts with the same places apart, and drops the text if its places are replaced', () => {
  const other = { ...kHeld, text: 'A B{neg}' }
  expect([sameProject(kHeld, other), firstChange(kHeld, other), firstChange(kHeld, kHeld)]).toEqual([false, 0, 2])
  expect(bodyOf(withToken(kHeld, 0, 2))).toEqual({ utterance: 'A#2 B' })
})

it('is continued by what is signed live', () => {
  expect(appended(kHeld, [signPlace('C', 0, 'comma'), signPlace('D')]).text).toBe(`${kText} , C D`)
  expect(appended(withPlaces(kEmpty, signs('A')), signs('B'))).toMatchObject({ places: [{ gloss: 'A' }, { gloss: 'B' }] })
  expect('text' in appended(withPlaces(kEmpty, []), signs('B'))).toBe(false)
})

it('is edited as text and by junctions only', () => {
  const composition = new Composition('text_project', () => Promise.reject(new Error('not asked')))
  composition.type({ places: signs('A', 'B'), text: kText })
  const [a] = composition.project.places
  composition.move(0, 1)
  composition.remove(0)
  composition.duplicate(0)
  composition.insert(0, signPlace('C'))
  expect([composition.byPlace, bodyOf(composition.project).utterance]).toEqual([false, kText])
  composition.type({ places: signs('A', 'B') })
  expect([composition.byPlace, composition.project.places[0].id]).toEqual([true, a.id])
})

it('knows when a bracket is still open', () => {
  expect(['[A', 'A{weak: B', '{neg: A} [B', '{neg: [A | weak: B]'].map((text) => isInBrackets(text, text.length))).toEqual([true, true, true, true])
  expect(['A', '[A]', '{neg: [A | weak: B]}', '"[A"', 'A "{'].map((text) => isInBrackets(text, text.length))).toEqual([false, false, false, false, false])
  expect(isInBrackets('[A] B', 2)).toBe(true)
})
