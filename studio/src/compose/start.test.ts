import { expect, it } from 'vitest'
import type { Candidate } from '../api/schema'
import { segmentAnswer } from '../api/test_answers'
import type { Api } from '../api/client'
import { ApiError } from '../api/fault'
import { glossesOf } from './complete'
import { isThere, kScenarios, played } from './examples'
import { kEmpty, signPlace, withPlaces } from './project'
import { mainSigns, projectFrom } from './start'
import { textOf } from './utterance'

const answer = (name: string, begin_ms: number, tier = 'Gloss', recording = 'r') => segmentAnswer({ name, begin_ms, end_ms: begin_ms + 400, tier, recording })

it('takes the sign tier with the most signs, on equal numbers the first by name', () => {
  expect(mainSigns([answer('A', 0, 'L'), answer('C', 900), answer('B', 500)]).map(({ name }) => name)).toEqual(['B', 'C'])
  expect(mainSigns([answer('A', 0, 'R'), answer('B', 0, 'L')]).map(({ name }) => name)).toEqual(['B'])
  expect(mainSigns([])).toEqual([])
})

it('converts a recording’s signs to places with their own tokens, or to pieces if they have none', async () => {
  const row = (token: number, recording: string, begin: number): Candidate => ({
    token,
    recording,
    frames: { begin, end: begin + 20 },
    cost: 0,
    target_cost: 0,
    target: {},
  })
  const tokens: Record<string, readonly Candidate[]> = { A: [row(1, 'q', 0), row(2, 'r', 0), row(3, 'r', 145)], B: [row(1, 'r', 50)] }
  const asked: string[] = []
  const api = {
    recording: async () => ({ frames: 200, frames_per_second: 50, clock_origin_ms: 0 }),
    signs: async () => [answer('A', 0), answer('B', 1000), answer('X', 1500), answer('A', 2900)],
    explained: async (_: string, { utterance }: { utterance: string }) => {
      asked.push(utterance)
      if (utterance.includes('X')) throw new ApiError("'X' cannot be signed", 404, 'not_found')
      return { places: utterance.split(' ').map((gloss) => ({ candidates: tokens[gloss], chosen: 0 })) }
    },
  } as unknown as Api
  const project = await projectFrom(api, 'demo', 'r')
  expect([textOf(project.places), project.original]).toEqual(['A#2 B#1 r@1500..1900 . A#3', 'r'])
  expect(asked).toEqual(['A B X', 'A', 'B X', 'B', 'X'])
})

it('applies the paper’s scenarios if their signs exist', () => {
  const meteo = ['BONJOUR', 'BRETAGNE', 'MATIN', 'NUAGES', 'PLUIE', 'DEMAIN', 'VENDREDI', 'NUAGES', 'MATIN', 'BROUILLARD']
  const recording = {
    ...withPlaces(
      kEmpty,
      meteo.map((gloss, k) => signPlace(gloss, k + 1)),
    ),
    original: 'meteo',
  }
  const [first, second] = kScenarios.map((scenario) => played(scenario, recording)!)
  expect(textOf(first.places)).toBe('BONJOUR#1 VANNES MATIN#3 NUAGES#4 PLUIE#5 MARSEILLE RENNES NUAGES#8 "LE MANS" BROUILLARD#10')
  expect(textOf(second.places)).toBe('BONJOUR#1 NUAGES#8 MATIN#9 BROUILLARD#10 DEMAIN#6 VENDREDI#7 BRETAGNE#2 MATIN#3 NUAGES#4 PLUIE#5')
  expect(second.original).toBe('meteo')
  expect(kScenarios.map((scenario) => played(scenario, withPlaces(recording, recording.places.slice(0, 3))))).toEqual([undefined, undefined])
  const glosses = glossesOf([...meteo, 'VANNES', 'MARSEILLE', 'RENNES'].map((gloss) => ({ gloss, tokens: 1 })))
  expect(kScenarios.map((scenario) => isThere(scenario, ['meteo'], glosses))).toEqual([false, true])
  expect(kScenarios.map((scenario) => isThere(scenario, ['villes'], glosses))).toEqual([false, false])
})
