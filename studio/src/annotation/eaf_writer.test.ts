import { expect, it } from 'vitest'
import { EafWriter } from './eaf_writer'

const kEaf = `<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT>
    <HEADER><PROPERTY NAME="lastUsedAnnotationId">144</PROPERTY></HEADER>
    <TIME_ORDER>
        <TIME_SLOT TIME_SLOT_ID="ts3" TIME_VALUE="500"/>
    </TIME_ORDER>
    <TIER LINGUISTIC_TYPE_REF="g" TIER_ID="Gloss"/>
    <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="g"/>
    <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="mine" CONSTRAINTS="Time_Subdivision"/>
</ANNOTATION_DOCUMENT>
`

it('goes on counting where the document stopped, and writes down where it stopped itself', () => {
  const writer = new EafWriter(kEaf)
  writer.add({
    name: 'A',
    type: 'x',
    annotations: [
      { begin: 600, end: 700, label: 'a < b' },
      { begin: 100, end: 200, label: '' },
    ],
  })
  writer.add({ name: 'B', type: 'mine', annotations: [] })
  const text = writer.written()
  expect([...text.matchAll(/ANNOTATION_ID="(a\d+)"/g)].map(([, id]) => id)).toEqual(['a145', 'a146'])
  expect(text).toContain('>146</PROPERTY>')
  expect([...text.matchAll(/TIME_SLOT_ID="(ts\d+)" TIME_VALUE="(\d+)"/g)].map(([, id, time]) => `${id} ${time}`)).toEqual([
    'ts6 100',
    'ts7 200',
    'ts3 500',
    'ts4 600',
    'ts5 700',
  ])
  expect([...text.matchAll(/LINGUISTIC_TYPE_ID="([^"]+)"/g)].map(([, name]) => name)).toEqual(['g', 'mine', 'x', 'mine 2'])
  expect(text.split('\n').length).toBeGreaterThan(kEaf.split('\n').length + 10)
})

it('leaves a document into which nothing is written as it is', () => expect(new EafWriter(kEaf).written()).toBe(kEaf))
