// @vitest-environment jsdom
import { expect, it } from 'vitest'
import { annotationNear, indexAt, nextBegin } from './document'
import { readEaf } from './eaf'

const kEaf = `<?xml version="1.0"?><ANNOTATION_DOCUMENT>
<HEADER><PROPERTY NAME="P">a &amp; b</PROPERTY></HEADER>
<TIME_ORDER><TIME_SLOT TIME_SLOT_ID="t1" TIME_VALUE="100"/><TIME_SLOT TIME_SLOT_ID="t2"/><TIME_SLOT TIME_SLOT_ID="t3"/>
<TIME_SLOT TIME_SLOT_ID="t4" TIME_VALUE="400"/><TIME_SLOT TIME_SLOT_ID="t5" TIME_VALUE="600"/></TIME_ORDER>
<TIER TIER_ID="Parts" PARENT_REF="Gloss">
 <ANNOTATION><REF_ANNOTATION ANNOTATION_ID="p2" ANNOTATION_REF="g1" PREVIOUS_ANNOTATION="p1">
  <ANNOTATION_VALUE>two</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>
 <ANNOTATION><REF_ANNOTATION ANNOTATION_ID="p1" ANNOTATION_REF="g1"><ANNOTATION_VALUE>one</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION></TIER>
<TIER TIER_ID="Gloss" PARTICIPANT="Zoé">
 <ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="g1" TIME_SLOT_REF1="t1" TIME_SLOT_REF2="t4">
  <ANNOTATION_VALUE>LE MANS</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
 <ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="g2" TIME_SLOT_REF1="t4" TIME_SLOT_REF2="t5">
  <ANNOTATION_VALUE>A &amp; B</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>
<TIER TIER_ID="Phase" PARENT_REF="Gloss">
 <ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="h1" TIME_SLOT_REF1="t1" TIME_SLOT_REF2="t2">
  <ANNOTATION_VALUE>Stroke</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>
</ANNOTATION_DOCUMENT>`

it('reads tiers in tree order, with the times that ELAN shows', () => {
  const { tiers, properties } = readEaf(kEaf)
  expect([properties, tiers.map(({ participant }) => participant)]).toEqual([{ P: 'a & b' }, ['Zoé', undefined, undefined]])
  expect(tiers.map(({ name, depth }) => [name, depth])).toEqual([
    ['Gloss', 0],
    ['Parts', 1],
    ['Phase', 1],
  ])
  expect(tiers[0].annotations[1]).toEqual({ begin: 400, end: 600, label: 'A & B' })
  expect(tiers[1].annotations).toEqual([
    { begin: 100, end: 250, label: 'one' },
    { begin: 250, end: 400, label: 'two' },
  ])
  expect(tiers[2].annotations[0]).toEqual({ begin: 100, end: 200, label: 'Stroke' })
})

it('finds the annotation at a time, half-open', () => {
  const tier = readEaf(kEaf).tiers[0]
  expect([99, 100, 399.9, 400, 600].map((ms) => indexAt(tier, ms))).toEqual([-1, 0, 0, 1, -1])
  expect([99, 100, 400, 600].map((ms) => annotationNear(tier, ms)?.begin)).toEqual([100, 100, 400, 400])
  expect([99, 100, 399.7].map((ms) => nextBegin(tier, ms, 1))).toEqual([100, 400, undefined])
  expect([100, 400, 401].map((ms) => nextBegin(tier, ms, -1))).toEqual([undefined, 100, 400])
})

it('terminates on circular references and missing names', () => {
  const ref = (id: string, to: string) =>
    `<ANNOTATION><REF_ANNOTATION ANNOTATION_ID="${id}" ANNOTATION_REF="${to}"><ANNOTATION_VALUE>x</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>`
  const { tiers } = readEaf(
    `<ANNOTATION_DOCUMENT><TIER TIER_ID="A" PARENT_REF="B">${ref('a', 'b')}</TIER>
     <TIER TIER_ID="B" PARENT_REF="A">${ref('b', 'a')}</TIER><TIER>${ref('c', 'none')}</TIER></ANNOTATION_DOCUMENT>`,
  )
  expect(tiers.map(({ name, annotations }) => [name, annotations.length])).toEqual([
    ['', 1],
    ['A', 1],
    ['B', 1],
  ])
})

it('reads ten thousand annotations with their parents', () => {
  const count = 10_000
  const many = (make: (k: number) => string) => Array.from({ length: count }, (_, k) => `<ANNOTATION>${make(k)}</ANNOTATION>`).join('')
  const slots = Array.from({ length: count + 1 }, (_, k) => `<TIME_SLOT TIME_SLOT_ID="t${k}" TIME_VALUE="${k}"/>`).join('')
  const eaf = `<ANNOTATION_DOCUMENT><TIME_ORDER>${slots}</TIME_ORDER>
    <TIER TIER_ID="G">${many((k) => `<ALIGNABLE_ANNOTATION ANNOTATION_ID="g${k}" TIME_SLOT_REF1="t${k}" TIME_SLOT_REF2="t${k + 1}"/>`)}</TIER>
    <TIER TIER_ID="H" PARENT_REF="G">${many((k) => `<REF_ANNOTATION ANNOTATION_ID="h${k}" ANNOTATION_REF="g${k}"/>`)}</TIER></ANNOTATION_DOCUMENT>`
  expect(readEaf(eaf).tiers[1].annotations[count - 1]).toEqual({ begin: count - 1, end: count, label: '' })
}, 120_000)

it('rejects text that is not an EAF', () => {
  expect(() => readEaf('<html/>')).toThrow('noEaf')
  expect(() => readEaf('<ANNOTATION_DOCUMENT>')).toThrow('noEaf')
})
