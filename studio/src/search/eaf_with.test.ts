// @vitest-environment jsdom
import { expect, it } from 'vitest'
import { readEaf } from '../annotation/eaf'
import type { Answer } from './answers'
import { eafWith } from './eaf_with'

const kEaf = `<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT><HEADER/><TIME_ORDER><TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="0"/>
<TIME_SLOT TIME_SLOT_ID="ts2"/><TIME_SLOT TIME_SLOT_ID="ts5" TIME_VALUE="900"/></TIME_ORDER>
<TIER LINGUISTIC_TYPE_REF="default" TIER_ID="query 1">
<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts5">
<ANNOTATION_VALUE>X</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="default"/><LOCALE LANGUAGE_CODE="en"/></ANNOTATION_DOCUMENT>`
const answer = (name: string, begin: number, end: number): Answer => ({ at: 0, recording: 'r', tier: 'Gloss', name, begin, end })

it('puts answers on separate tiers without overlaps, and leaves everything else unchanged', () => {
  const made = eafWith(kEaf, [answer('B & <C>', 500, 800), answer('A', 0, 600), answer('D', 600, 700)])
  const { tiers } = readEaf(made)
  expect(tiers.map(({ name }) => name)).toEqual(['query 1', 'query 2', 'query 3'])
  expect(tiers[0].annotations).toEqual([{ begin: 0, end: 900, label: 'X' }])
  expect(tiers[1].annotations).toEqual([
    { begin: 0, end: 600, label: 'A' },
    { begin: 600, end: 700, label: 'D' },
  ])
  expect(tiers[2].annotations).toEqual([{ begin: 500, end: 800, label: 'B & <C>' }])
  const order = [...made.matchAll(/<(HEADER|TIME_ORDER|TIER|LINGUISTIC_TYPE|LOCALE)\b/g)].map(([, name]) => name)
  expect(order).toEqual(['HEADER', 'TIME_ORDER', 'TIER', 'TIER', 'TIER', 'LINGUISTIC_TYPE', 'LINGUISTIC_TYPE', 'LOCALE'])
  const ids = [...made.matchAll(/(?:TIME_SLOT_ID|ANNOTATION_ID)="([^"]+)"/g)].map(([, id]) => id)
  expect(new Set(ids).size).toBe(ids.length)
  // The next program that writes into it continues the numbering; slots are ordered by time.
  expect(made).toContain('<PROPERTY NAME="lastUsedAnnotationId">4</PROPERTY>')
  const times = [...made.matchAll(/TIME_VALUE="(\d+)"/g)].map(([, time]) => Number(time))
  expect(times).toEqual(times.toSorted((a, b) => a - b))
  const kept = made.split('\n'),
    before = kEaf.split('\n')
  for (const line of [before[0], ...before.slice(3, 6)]) expect(kept).toContain(line)
  expect(kept.length).toBeGreaterThan(20)
})

it('rejects text that is not an EAF', () => expect(() => eafWith('<x/>', [])).toThrow('noEaf'))
