import { expect, it } from 'vitest'
import { extended, paired as pairedBy, readTable, tableOf, type Pair } from './pairs'

const pair = (motion: string | null, annotation: string | null, face: string | null = null): Pair => ({ motion, annotation, face, signer: '' })
const kPairs = [pair('a.bvh', 'aa.eaf', 'a.face.csv'), pair('b.bvh', null), pair(null, 'c.eaf')]
const stem = (name: string) => name.split('.')[0]
const paired = (pairs: readonly Pair[], key: string, part: 'motion' | 'annotation' | 'face', file: string | null) => pairedBy(pairs, key, part, file, stem)
const short = (pairs: readonly Pair[]) => pairs.map(({ motion, annotation, face }) => [motion, annotation, face].map((name) => name ?? '-').join(' '))

it('assigns another annotation to a motion, and leaves no file out', () => {
  expect(short(paired(kPairs, 'b.bvh', 'annotation', 'c.eaf'))).toEqual(['a.bvh aa.eaf a.face.csv', 'b.bvh c.eaf -'])
  expect(short(paired(kPairs, 'a.bvh', 'annotation', 'c.eaf'))).toEqual(['a.bvh c.eaf a.face.csv', '- aa.eaf -', 'b.bvh - -'])
  // One annotation may belong to two motions.
  expect(short(paired(kPairs, 'b.bvh', 'annotation', 'aa.eaf'))).toEqual(['a.bvh aa.eaf a.face.csv', 'b.bvh aa.eaf -', '- c.eaf -'])
})

it('splits a recording, and joins it again', () => {
  const split = paired(kPairs, 'a.bvh', 'annotation', null)
  expect(short(split)).toEqual(['a.bvh - a.face.csv', '- aa.eaf -', 'b.bvh - -', '- c.eaf -'])
  expect(short(paired(split, 'aa.eaf', 'motion', 'a.bvh'))).toEqual(short(kPairs))
})

it('assigns another motion with its face to an annotation', () => {
  expect(short(paired(kPairs, 'c.eaf', 'motion', 'a.bvh'))).toEqual(['a.bvh c.eaf a.face.csv', '- aa.eaf -', 'b.bvh - -'])
  expect(short(paired(kPairs, 'a.bvh', 'motion', null))).toEqual(['a.bvh - a.face.csv', '- aa.eaf -', 'b.bvh - -', '- c.eaf -'])
})

it('moves a face, which belongs to a single motion', () => {
  expect(short(paired(kPairs, 'b.bvh', 'face', 'a.face.csv'))).toEqual(['a.bvh aa.eaf -', 'b.bvh - a.face.csv', '- c.eaf -'])
})

it('writes tables that it can read, including quotes', () => {
  const pairs = [
    { ...pair('one, two.bvh', 'a "b".eaf', 'f.face.csv'), signer: 'Zoé', offset: '-120', faceOffset: '20' },
    pair(null, 'c.eaf'),
    { ...pair('d.bvh', null), name: 'day 1/d' },
  ]
  const names = new Set(['one, two.bvh', 'a "b".eaf', 'f.face.csv', 'c.eaf', 'd.bvh', 'd.face.csv'])
  expect(readTable(tableOf(pairs), names)).toEqual({ pairs, faults: [] })
  // The face file next to a motion is used, unless the table says that there is none.
  expect(short(readTable('d.bvh,\n', names).pairs)).toEqual(['d.bvh - d.face.csv'])
  expect(tableOf([pair('d.bvh', null)])).toMatch(/\nd.bvh,,,,-,,\n$/)
})

it('reads tables with paths, and reports files that were not chosen', () => {
  const text = '\ufeffmotion,annotation\r\nday 1/a.bvh,..\\eaf\\aa.eaf\r\n\r\nb.bvh,missing.eaf\n,,someone\n"x\ny.bvh",\n'
  const { pairs, faults } = readTable(text, new Set(['a.bvh', 'aa.eaf', 'b.bvh', 'x\ny.bvh']))
  expect(short(pairs)).toEqual(['a.bvh aa.eaf -', 'x\ny.bvh - -'])
  expect(faults).toEqual([{ line: 4, file: 'missing.eaf' }, { line: 5 }])
})

it('matches new files by their stem, and forgets removed ones', () => {
  const all = { motion: ['a.bvh', 'd.bvh'], annotation: ['aa.eaf', 'd.eaf', 'e.eaf'], face: ['d.face.csv'] }
  const pairs = extended([pair('a.bvh', 'c.eaf', 'a.face.csv'), pair('gone.bvh', null)], new Set(Object.values(all).flat()), all, (name) => name.split('.')[0])
  expect(short(pairs)).toEqual(['a.bvh - -', 'd.bvh d.eaf d.face.csv', '- aa.eaf -', '- e.eaf -'])
})

it('leaves out an annotation with the name of a recording that has motion', () => {
  const pairs = [pair('a.bvh', 'a.eaf'), pair(null, 'c.eaf')]
  const split = paired(pairs, 'a.bvh', 'annotation', null)
  expect(short(split)).toEqual(['a.bvh - -', '- c.eaf -'])
  expect(short(paired(split, 'a.bvh', 'annotation', 'a.eaf'))).toEqual(['a.bvh a.eaf -', '- c.eaf -'])
  expect(short(paired(pairs, 'c.eaf', 'motion', 'a.bvh'))).toEqual(['a.bvh c.eaf -'])
})

it('removes a motion from the annotation of its name, and a face from its motion', () => {
  const pairs = [pair('a.bvh', 'a.eaf', 'a.face.csv'), pair('b.bvh', null)]
  const alone = paired(pairs, 'a.bvh', 'motion', null)
  expect(short(alone)).toEqual(['- a.eaf -', 'b.bvh - -'])
  expect(short(paired(alone, 'a.eaf', 'motion', 'a.bvh'))).toEqual(['a.bvh a.eaf -', 'b.bvh - -'])
  expect(short(paired(pairs, 'a.bvh', 'face', null))).toEqual(['a.bvh a.eaf -', 'b.bvh - -'])
})
