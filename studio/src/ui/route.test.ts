import { expect, it } from 'vitest'
import { addressOf, parseRoute, linkBack, withRecording, type Route } from './route'

it('writes the view to the address, and reads it back', () => {
  const routes: Route[] = [
    { page: 'home' },
    { page: 'recordings', database: 'demo' },
    { page: 'compose', database: 'demo', recording: undefined, state: { utterance: 'VANNES "LE MANS"' } },
    { page: 'phases', database: 'demo', recording: 'a/b', state: {} },
    { page: 'recording', database: 'a/b', recording: 'ISL Thanks?', compare: 'été', at: 1.5, span: undefined },
    { page: 'recording', database: 'demo', recording: 'meteo', compare: undefined, at: 0, span: [-120, 3400] },
    { page: 'search', database: 'demo', recording: undefined, state: { q: 'gloss = "A" & $X', view: 'grid' } },
    { page: 'sign', database: 'demo', utterance: 'VANNES , "LE MANS"#2', pace: 'live' },
    { page: 'edit', database: 'demo', recording: 'meteo', replace: ['A=B', 'MATIN#2="LE MANS"'], swap: undefined },
  ]
  for (const route of routes) expect(parseRoute(addressOf(route))).toEqual(route)
})

it('reads addresses of an earlier version', () => {
  expect(parseRoute('#/demo/recording/meteo?at=2.2&beside=villes')).toMatchObject({ compare: 'villes', at: 2.2 })
})

it('shows the start page for an empty address, and the recordings of a database if nothing else is recognized', () => {
  for (const hash of ['', '#', '#/', '#/%E0%A4%A']) expect(parseRoute(hash)).toEqual({ page: 'home' })
  for (const hash of ['#/demo', '#/demo/nothing/x']) expect(parseRoute(hash)).toEqual({ page: 'recordings', database: 'demo' })
})

it('selects nothing if the span is invalid', () => {
  for (const span of ['', 'x', '5..5', '9..1', '1..']) expect(parseRoute(`#/demo/recording/meteo?span=${span}`)).toMatchObject({ span: undefined })
})

it('leads to another recording', () => {
  expect(withRecording('#/demo/recording/metoe?at=3', 'météo 1')).toBe('#/demo/recording/m%C3%A9t%C3%A9o%201')
  expect(withRecording('#/demo/search', 'meteo')).toBe(undefined)
})

it('has an address to return to from what does not exist', () => {
  expect(linkBack('#/demo/recording/gone?at=3')).toBe('#/demo')
  expect(linkBack('#/demo/phases/gone')).toBe('#/demo')
  expect(linkBack('#/no%20such')).toBe('#/')
  expect(linkBack('#/gone/search')).toBe('#/')
})
