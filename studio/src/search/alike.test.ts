import { expect, it } from 'vitest'
import { alikeOf, alikeQuery } from './alike'

const document = {
  tiers: [
    { name: 'Gloss', depth: 0, annotations: [{ begin: 1200, end: 2980, label: 'BONJOUR' }] },
    {
      name: 'Phase',
      parent: 'Gloss',
      depth: 1,
      annotations: [
        { begin: 1200, end: 1900, label: 'Preparation' },
        { begin: 1900, end: 2460, label: 'Stroke' },
      ],
    },
  ],
}

it('searches for signs similar to a span, and for phases if it is one', () => {
  expect(alikeQuery('me"teo', 1200, 2980, document)).toBe('like("me\\"teo"@1200..2980)')
  expect(alikeQuery('meteo', 1900.0000001, 2460, document)).toBe('phase = stroke & like("meteo"@1900..2460)')
  expect(alikeQuery('meteo', 1500, 2460.4, document)).toBe('like("meteo"@1500..2460)')
})

it('searches for phases similar to a phase that was found', () => {
  const stroke = { at: 0, recording: 'villes', tier: 'Phase', name: 'VANNES stroke', begin: 1810, end: 2390 }
  expect(alikeOf(stroke, 'gloss = "VANNES" & phase = stroke')).toBe('phase = stroke & like("villes"@1810..2390)')
  expect(alikeOf(stroke, 'gloss = "VANNES stroke"')).toBe('like("villes"@1810..2390)')
  expect(alikeOf({ ...stroke, name: 'VANNES' }, 'phase = stroke')).toBe('like("villes"@1810..2390)')
})
