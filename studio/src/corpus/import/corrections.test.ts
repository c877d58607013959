import { expect, it } from 'vitest'
import { choicesOf, fits, grouped, isRight, kNone, kSettings, fixOf, parametersOf, readingOf, readRig, rigText, type Corrections } from './corrections'

const setting = (name: string) => kSettings.find((one) => one.name === name)!

it('sends what was corrected, and only what applies to the file', () => {
  const all: Corrections = { settings: { up: 'z', take: '2', unit: 'cm' } }
  const one: Corrections = { settings: { unit: '0,5', mirror: 'yes', offset_ms: '-12,5', sync: '0@10  100@1010' } }
  expect(parametersOf(all, one, 'a.bvh')).toEqual({ up: 'z', unit: '0.5', mirror: true, offset_ms: -12.5, sync: ['0@10', '100@1010'] })
  expect(parametersOf(all, undefined, 'a.glb')).toEqual({ unit: 'cm', take: '2' })
  expect(parametersOf(all, one, null)).toEqual({ unit: '0.5', offset_ms: -12.5, sync: ['0@10', '100@1010'] })
})

it('knows which parameters determine how motion is read', () => {
  const all: Corrections = { settings: { up: 'z', unit: 'cm', root_order: 'rotation_first', mirror: 'yes', offset_ms: '10', replace_motion: 'yes' } }
  expect(readingOf(parametersOf(all, { settings: {}, signer: 'Zoé' }, 'a.bvh'))).toEqual({ up: 'z', unit: 'cm', root_order: 'rotation_first', mirror: true })
  expect(readingOf(parametersOf({ settings: { source_rate: '60', take: '2' } }, undefined, 'a.glb'))).toEqual({ source_rate: '60', take: '2' })
  expect(readingOf(parametersOf(kNone, undefined, 'a.bvh'))).toEqual({})
})

it('leaves out what is typed wrong', () => {
  expect(parametersOf(kNone, { settings: { unit: 'feet', offset_ms: '1 s', up: 'z' } }, 'a.bvh')).toEqual({ up: 'z' })
  expect(['', 'cm', '0.01', '1e-3', 'ft'].map((text) => isRight(setting('unit'), text))).toEqual([true, true, true, true, false])
  expect(['30', '30000/1001', 'fast'].map((text) => isRight(setting('source_rate'), text))).toEqual([true, true, false])
  expect(fits(setting('take'), 'x.GLB')).toBe(true)
})

it('names tiers with their hands, and those with a colon in all three parts', () => {
  const tiers = [
    { tier: 'Gloss', role: 'signs', hand: 'both' },
    { tier: 'Gloss L', role: 'signs', hand: 'left' },
    { tier: 'a:b', role: 'signs', hand: 'both' },
    { tier: 'Phase', role: 'phases', hand: 'both' },
    { tier: 'Note', role: '', hand: 'both' },
  ] as const
  expect(parametersOf(kNone, { settings: {}, tiers }, 'a.bvh')).toEqual({ sign_tier: ['Gloss', 'Gloss L:left', 'a:b:both:'], phase_tier: ['Phase'] })
})

it('declares that there is no tier if the user gave all another role, or wants none for any recording', () => {
  const tiers = [
    { tier: 'Gloss', role: 'signs', hand: 'both' },
    { tier: 'Phase', role: '', hand: 'both' },
  ] as const
  const none = tiers.map((tier) => ({ ...tier, role: '' as const }))
  const all: Corrections = { settings: { no_phase_tier: 'yes', no_sign_tier: 'yes' } }
  expect(parametersOf(kNone, undefined, 'a.bvh')).toEqual({})
  expect(parametersOf(kNone, { settings: {}, tiers }, 'a.bvh')).toEqual({ sign_tier: ['Gloss'], no_phase_tier: true })
  expect(parametersOf(kNone, { settings: {}, tiers: none }, 'a.bvh')).toEqual({ no_sign_tier: true, no_phase_tier: true })
  expect(parametersOf(all, undefined, 'a.bvh')).toEqual({ no_sign_tier: true, no_phase_tier: true })
  // The corrections of one recording take precedence.
  expect(parametersOf(all, { settings: {}, tiers }, 'a.bvh')).toEqual({ sign_tier: ['Gloss'], no_phase_tier: true })
})

it('makes one call for recordings with the same parameters', () => {
  const rig = { left_hand: 'wrist_a' }
  const groups = grouped(
    [
      { key: 'a', motion: 'a.bvh' },
      { key: 'b', motion: 'b.bvh', one: { settings: {}, rig } },
      { key: 'c', motion: 'c.bvh', one: { settings: {} } },
      { key: 'd', motion: null, one: { settings: {}, rig } },
    ],
    { settings: {}, signer: 'Zoé' },
  )
  expect(groups.map(({ keys, rig: text }) => [keys, text])).toEqual([
    [['a', 'c', 'd'], ''],
    [['b'], 'left_hand = wrist_a\n'],
  ])
})

it('reads mapping files as they are written', () => {
  const text = '# part = joint\nleft_hand = wrist#a  # beyond\n\njaw =\nnonsense\n'
  expect(readRig(text)).toEqual({ left_hand: 'wrist#a', jaw: '' })
  expect(readRig(rigText({ left_hand: 'LeftHand', jaw: '' }))).toEqual({ left_hand: 'LeftHand', jaw: '' })
})

it('takes the values of remedies that can be set here', () => {
  const rotation = [
    { parameter: 'root_order', value: 'rotation_first' },
    { parameter: 'root_unit', value: 'm' },
  ]
  expect(fixOf(rotation)).toEqual({ root_order: 'rotation_first', root_unit: 'm' })
  expect(fixOf([{ parameter: 'replace_motion', value: 'true' }])).toEqual({ replace_motion: 'yes' })
  expect([fixOf(undefined), fixOf([{ parameter: 'up' }]), fixOf([{ parameter: 'if_annotation', value: 'none' }])]).toEqual([undefined, undefined, undefined])
})

it('names the settings that the user has to choose', () => {
  expect(choicesOf([{ parameter: 'unit' }, { parameter: 'up' }, { parameter: 'rig' }, { parameter: 'take', value: '2' }])).toEqual(['up', 'unit'])
  expect(choicesOf(undefined)).toEqual([])
})
