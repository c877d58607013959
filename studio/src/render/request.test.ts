import { expect, it } from 'vitest'
import { checked, putOf, requestIn } from './request'

const kGood = {
  database: 'demo',
  call: 'recording',
  parameters: { recording: 'meteo' },
  character: '',
  width: 1280,
  height: 720,
  rate: 30,
  view: 'front',
  kind: 'png',
  at_ms: [0],
  put: '/api/renders/a',
}

it('a request is read after #', () => {
  expect(checked(requestIn('#' + encodeURIComponent(JSON.stringify(kGood))))).toEqual(kGood)
  expect(() => requestIn('#%7b')).toThrow('no render request')
  expect(() => requestIn('#%')).toThrow('no render request')
  expect(putOf({ put: 'https://elsewhere' })).toBeUndefined()
  expect(putOf(null)).toBeUndefined()
})

it('an invalid request is rejected with the invalid field', () => {
  for (const [change, line] of [
    [{ call: 'dance' }, 'call'],
    [{ parameters: {} }, 'recording'],
    [{ width: 1280.5 }, 'width'],
    [{ height: 9000 }, 'height'],
    [{ rate: NaN }, 'rate'],
    [{ view: 'above' }, 'view'],
    [{ kind: 'gif' }, 'kind'],
    [{ at_ms: [] }, 'moments'],
    [{ at_ms: ['1'] }, 'moments'],
    [{ kind: 'webm' }, 'at_ms is for png'],
    [{ put: undefined }, 'put'],
    [{ character: undefined }, 'character'],
    [{ database: '' }, 'database'],
  ] as const) {
    expect(() => checked({ ...kGood, ...change }), JSON.stringify(change)).toThrow(line)
  }
})
