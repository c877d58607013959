import { expect, it } from 'vitest'
import doc from '../../../docs/studio_compose.md?raw'
import earlier from '../../../testdata/compat/project.signweave.json?raw'
import { addressOf, parseRoute } from '../ui/route'
import { bodyOf } from './body'
import { FileFault, fileOf, readFile } from './file'
import { kEmpty, piecePlace, sameProject, signPlace, withHow, withJoin, withPlaces, type Project } from './project'
import { projectOf, stateOf } from './state'
import { signs } from './test_places'

const kPlaces = [signPlace('VANNES'), signPlace('MATIN', 2), signPlace('LE MANS', 0, 'comma'), piecePlace('ISL Thanks', 1200, 3400)]
const kFull: Project = {
  ...withHow(withJoin(withJoin(withPlaces(kEmpty, kPlaces), 1, { method: 'gap', durationMs: 450, tempo: 1.5 }), 3, { tempo: 0.5 }), {
    transition: 'hermite',
    duration: 'corpus',
    tempo: 1.25,
    align: 'ground',
    rate: '30000/1001',
  }),
  original: 'meteo',
}

it('is unchanged by writing to and reading from an address', () => {
  const route = parseRoute(addressOf({ page: 'compose', database: 'demo', state: stateOf(kFull) }))
  const state = 'state' in route ? route.state : {}
  const { project, wrong } = projectOf(state, { places: kPlaces })
  expect(state.utterance).toBe('VANNES MATIN#2 , "LE MANS" "ISL Thanks"@1200..3400')
  expect([sameProject(project, kFull), wrong]).toEqual([true, []])
  expect(stateOf(kEmpty)).toEqual({})
  expect(projectOf({}, { places: [] })).toEqual({ project: kEmpty, wrong: [] })
})

it('names unreadable parts of an address, and keeps the rest', () => {
  const given = {
    utterance: 'A B',
    duration: '1.5',
    tempo: '9',
    align: 'x',
    rate: 'y',
    transition: '1;2',
    junctions: '1=gap;7=gap;1=,',
  }
  const { project, wrong } = projectOf(given, { places: signs('A', 'B') })
  expect(wrong).toEqual(['transition', 'duration', 'tempo', 'align', 'rate', 'junctions'])
  expect(project.places.map(({ join }) => join)).toEqual([{}, { method: 'gap' }])
  expect(projectOf({ utterance: 'A "B' }, undefined)).toEqual({ project: kEmpty, wrong: ['utterance'] })
})

it('is unchanged by writing to and reading from a file', () => {
  const { project, database } = readFile(fileOf(kFull, 'demo'))
  expect([sameProject(project, kFull), database]).toEqual([true, 'demo'])
  expect(sameProject(readFile(fileOf(kEmpty, 'demo')).project, kEmpty)).toBe(true)
})

it('reads a file of an earlier version', () => {
  const { project, database } = readFile(earlier)
  expect([bodyOf(project), project.original, database]).toEqual([
    { utterance: 'VANNES , MATIN#2 villes@1200..3400', transition: 'hermite', duration: 400, tempo: 1.2, rate: '60', junctions: ['1=gap,450ms,x1.5'] },
    'meteo',
    'demo',
  ])
})

it('reads the file in the documentation', () => {
  const { project, database } = readFile(/```json\n([^]*?)```/.exec(doc)![1])
  expect([bodyOf(project), project.original, database]).toEqual([
    { utterance: 'VANNES , MATIN#2 villes@1200..3400', transition: 'hermite', duration: 400, tempo: 1.2, rate: '60', junctions: ['1=gap,450ms,x1.5'] },
    'meteo',
    'demo',
  ])
})

it('rejects a file that it does not fully understand, with the position', () => {
  const of = (text: string) => {
    try {
      readFile(text)
    } catch (fault) {
      const { wrong, detail } = fault as FileFault
      return [wrong, detail].filter(Boolean).join(' ')
    }
    return 'taken'
  }
  // eslint-disable-next-line @typescript-eslint/no-explicit-any -- a file may contain anything
  type SavedFile = Record<string, any>
  const refused = (change: (file: SavedFile) => unknown) => {
    const file = JSON.parse(fileOf(kFull, 'demo')) as SavedFile
    change(file)
    return of(JSON.stringify(file))
  }
  expect(refused(() => {})).toBe('taken')
  expect(of('{')).toBe('notJson')
  expect(['[]', 'null', '{"a":1}'].map(of)).toEqual(['notProject', 'notProject', 'notProject'])
  expect(refused((file) => (file.version = 3))).toBe('newerVersion 3')
  expect(refused((file) => (file.version = 0))).toBe('badValue version')
  expect(refused((file) => (file.colour = 'red'))).toBe('unknownField colour')
  expect(refused((file) => (file.settings.swing = 1))).toBe('unknownField settings.swing')
  expect(refused((file) => (file.settings.tempo = 'fast'))).toBe('badValue settings.tempo')
  expect(refused((file) => (file.places[1].hand = 'left'))).toBe('unknownField places[1].hand')
  expect(refused((file) => (file.places[1].junction.curve = 1))).toBe('unknownField places[1].junction.curve')
  expect(refused((file) => (file.places[1].junction.duration_ms = -1))).toBe('badValue places[1].junction.duration_ms')
  expect(refused((file) => (file.places[0].gloss = ''))).toBe('badValue places[0].gloss')
  expect(refused((file) => (file.places[3].to_ms = 1))).toBe('badValue places[3].to_ms')
  expect(refused((file) => (file.places = {}))).toBe('badValue places')
  expect(refused((file) => (file.places[0] = 'A'))).toBe('badValue places[0]')
  const many = (n: number) => refused((file) => (file.places = Array.from({ length: n }, () => ({ gloss: 'A' }))))
  expect([many(10_000), many(10_001)]).toEqual(['taken', 'tooManyPlaces 10001'])
})
