// @vitest-environment jsdom
import { expect, it } from 'vitest'
import { readEaf } from '../../annotation/eaf'
import { emptyEaf, isChecked, readChecked, rewritten, standOf, writeChecked } from './checked_tiers'
import { acceptedAll, decided, kEmpty, put, type Review } from './review'
import { decoded, encoded, parseXml, unescaped } from '../../annotation/xml_text'

const kEaf = `<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE x [<!ENTITY a "<TIER>">]>
<ANNOTATION_DOCUMENT AUTHOR='Zoé &amp; "co"' DATE="2026-01-01T00:00:00+00:00" FORMAT="3.0">
    <HEADER MEDIA_FILE="" TIME_UNITS="milliseconds">
        <PROPERTY NAME="lastUsedAnnotationId">7</PROPERTY>
    </HEADER>
    <!-- <TIER TIER_ID="no"> -->
    <TIME_ORDER>
        <TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="100"/>
        <TIME_SLOT TIME_SLOT_ID="ts9"/>
        <TIME_SLOT TIME_SLOT_ID="x"   TIME_VALUE="300" ></TIME_SLOT>
    </TIME_ORDER>
    <TIER LINGUISTIC_TYPE_REF="gloss" TIER_ID="Gloss" PARTICIPANT="Zoé">
        <ANNOTATION>
          <ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="x">
            <ANNOTATION_VALUE><![CDATA[A </TIER> B]]></ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
    </TIER>
    <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="gloss" TIME_ALIGNABLE="true"/>
    <LOCALE LANGUAGE_CODE="en"/>
</ANNOTATION_DOCUMENT>
`
const accepted = (hand: 'right' | 'left', kind: string, begin: number, end: number) => ({ hand, kind, begin, end, state: 'accepted' as const })
const kReview: Review = [accepted('right', 'preparation', 50, 150), accepted('right', 'stroke', 150, 400), accepted('left', 'hold', 100, 300)].reduce(
  put,
  kEmpty,
)
/** Returns the lines of `before` missing in `after`, and the other way round. */
function difference(before: string, after: string): { gone: string[]; come: string[] } {
  const lines = (text: string) => text.split('\n').map((line) => line.trim())
  const count = (list: string[]) => {
    const map = new Map<string, number>()
    for (const one of list) map.set(one, (map.get(one) ?? 0) + 1)
    return map
  }
  const a = count(lines(before)),
    b = count(lines(after))
  return {
    gone: [...a].filter(([line, n]) => (b.get(line) ?? 0) < n).map(([line]) => line),
    come: [...b].filter(([line, n]) => (a.get(line) ?? 0) < n).map(([line]) => line),
  }
}

it('adds a tier for each hand, and leaves every other byte unchanged', () => {
  const { text, tiers } = writeChecked(kEaf, kReview, 'A <b>')
  expect(tiers).toEqual([
    { hand: 'right', name: 'Phase RH (checked)', count: 2, unseen: 0 },
    { hand: 'left', name: 'Phase LH (checked)', count: 1, unseen: 0 },
  ])
  const { gone, come } = difference(kEaf, text)
  expect(gone).toEqual(['<PROPERTY NAME="lastUsedAnnotationId">7</PROPERTY>'])
  expect(come).toContain('<PROPERTY NAME="lastUsedAnnotationId">10</PROPERTY>')
  expect(come).toContain(
    '<TIER ANNOTATOR="signweave, checked by A &lt;b&gt;" LINGUISTIC_TYPE_REF="checked phase" PARTICIPANT="Zoé" TIER_ID="Phase RH (checked)">',
  )
  const { tiers: read } = readEaf(text)
  expect(read.map(({ name }) => name)).toEqual(['Gloss', 'Phase RH (checked)', 'Phase LH (checked)'])
  expect(read[1].annotations).toEqual([
    { begin: 50, end: 150, label: 'preparation' },
    { begin: 150, end: 400, label: 'stroke' },
  ])
  expect(read[0].annotations).toEqual(readEaf(kEaf).tiers[0].annotations)
  // Slots are ordered by their times.
  const slots = parseXml(text)!
    .children.find(({ name }) => name === 'TIME_ORDER')!
    .children.flatMap(({ attributes }) => (attributes.TIME_VALUE ? [Number(attributes.TIME_VALUE)] : []))
  expect(slots).toEqual(slots.toSorted((a, b) => a - b))
  expect(slots.length).toBe(8)
})

it('starts a second review from the written phases, and rewrites them', () => {
  const once = writeChecked(kEaf, kReview, '').text
  const read = readChecked(readEaf(once))!
  expect([read.phases.right.map(({ kind, begin, end, state }) => [kind, begin, end, state]), read.phases.left.length]).toEqual([
    [
      ['preparation', 50, 150, 'accepted'],
      ['stroke', 150, 400, 'accepted'],
    ],
    1,
  ])
  const twice = writeChecked(once, read, '').text
  expect(writeChecked(once, decided(read, 1, 'rejected'), '').text).not.toMatch(/preparation/)
  // Only ids differ.
  const plain = (text: string) =>
    text
      .replaceAll(/"(ts|a)\d+"|>\d+</g, '""')
      .split('\n')
      .toSorted()
      .join('\n')
  expect(plain(twice)).toBe(plain(once))
  expect(parseXml(twice)!.children.find(({ name }) => name === 'TIME_ORDER')!.children.length).toBe(9)
  // Tiers without phases are removed entirely.
  const none = writeChecked(once, kEmpty, '')
  expect([none.tiers, /TIER_ID="Phase/.test(none.text), none.text.includes('>none<')]).toEqual([[], false, true])
  expect(readChecked(readEaf(none.text))).toBeUndefined()
})

it('writes under another name if other tiers depend on its own', () => {
  const once = writeChecked(kEaf, kReview, '').text
  const hung = once.replace(
    '    <LINGUISTIC_TYPE ',
    '    <TIER LINGUISTIC_TYPE_REF="note" PARENT_REF="Phase RH (checked)" TIER_ID="Note"/>\n    <LINGUISTIC_TYPE ',
  )
  const { text, tiers } = writeChecked(hung, put(readChecked(readEaf(hung))!, accepted('right', 'hold', 500, 600)), '')
  expect(tiers.map(({ name }) => name)).toEqual(['Phase RH (checked 2)', 'Phase LH (checked)'])
  expect(readEaf(text).tiers.find(({ name }) => name === 'Phase RH (checked)')!.annotations.length).toBe(2)
  expect(readChecked(readEaf(text))!.phases.right.length).toBe(3)
  expect([isChecked('Phase LH (checked)'), isChecked('Phase LH (proposed)'), isChecked('Phase RH (checked 2)')]).toEqual(['left', undefined, 'right'])
})

it('preserves checked phases that someone else stored meanwhile', () => {
  const before = writeChecked(kEaf, kReview, 'A').text,
    theirs = writeChecked(before, decided(readChecked(readEaf(before))!, 1, 'rejected'), 'B').text
  const [none, first, then] = [kEaf, before, theirs].map((text) => standOf(readEaf(text)))
  expect([rewritten(first, then), rewritten(none, then), rewritten(first, none), rewritten(first, first)]).toEqual([['right'], ['right', 'left'], [], []])
  const { text, tiers } = writeChecked(theirs, kReview, 'A', { hands: ['right'] })
  expect(tiers.map(({ name }) => name)).toEqual(['Phase RH (checked 2)', 'Phase LH (checked)'])
  expect(readEaf(text).tiers.map(({ name, annotations }) => [name, annotations.length])).toEqual([
    ['Gloss', 1],
    ['Phase RH (checked)', 1],
    ['Phase RH (checked 2)', 2],
    ['Phase LH (checked)', 1],
  ])
})

it('records which phases were accepted all at once, and reads this back', () => {
  const open = put(put(kReview, { ...accepted('right', 'hold', 400, 500), state: 'open' }), { ...accepted('left', 'hold', 300, 500), state: 'open' })
  const { text, tiers } = writeChecked(kEaf, acceptedAll(open), 'Z')
  expect(tiers.map(({ unseen }) => unseen)).toEqual([1, 1])
  expect(text).toContain(
    '>Phase RH (checked), Phase LH (checked): proposed by signweave from motion alone, 3 of 5 phases checked by Z, ' +
      '2 accepted all at once without being looked at<',
  )
  expect(text).toContain('ANNOTATOR="signweave, partly checked by Z"')
  expect(text).not.toContain('each phase checked')
  const read = readChecked(readEaf(text), text)!
  expect([...read.phases.right, ...read.phases.left].map(({ unseen }) => unseen ?? false)).toEqual([false, false, true, false, true])
  // After a person has looked at them and stored them, the file says so.
  const seen = [3, 5].reduce((review, id) => decided(review, id, 'accepted'), read)
  const after = writeChecked(text, seen, 'Z').text
  expect([
    after.includes('each phase checked by Z'),
    after.includes('partly'),
    readChecked(readEaf(after), after)!.phases.right.some(({ unseen }) => unseen),
  ]).toEqual([true, false, false])
})

it('uses another name for its type if the existing one has more constraints', () => {
  const used = kEaf.replace('LINGUISTIC_TYPE_ID="gloss"', 'LINGUISTIC_TYPE_ID="checked phase" CONSTRAINTS="Time_Subdivision"')
  expect(writeChecked(used, kReview, '').text).toContain('LINGUISTIC_TYPE_REF="checked phase 2"')
})

it('writes into empty documents, and keeps line endings', () => {
  const { text } = writeChecked(emptyEaf('a & b.bvh', '2026-01-01T00:00:00Z'), kReview, '')
  expect(readEaf(text).tiers.map(({ name, annotations }) => [name, annotations.length])).toEqual([
    ['Phase RH (checked)', 2],
    ['Phase LH (checked)', 1],
  ])
  for (const eaf of [
    '<ANNOTATION_DOCUMENT><HEADER/></ANNOTATION_DOCUMENT>',
    '<ANNOTATION_DOCUMENT><HEADER TIME_UNITS="milliseconds" /><TIME_ORDER ></TIME_ORDER></ANNOTATION_DOCUMENT>',
  ]) {
    const made = writeChecked(eaf, kReview, '').text
    expect(readEaf(made).tiers[0].annotations[1]).toEqual({ begin: 150, end: 400, label: 'stroke' })
    expect([...made.matchAll(/<(HEADER|TIME_ORDER|TIER|LINGUISTIC_TYPE)\b/g)].map(([, name]) => name)).toEqual([
      'HEADER',
      'TIME_ORDER',
      'TIER',
      'TIER',
      'LINGUISTIC_TYPE',
    ])
  }
  const windows = writeChecked(kEaf.replaceAll('\n', '\r\n'), kReview, '').text
  expect(windows.replaceAll('\r\n', '').includes('\n')).toBe(false)
})

it('rejects text that is not an EAF, or truncated', () => {
  for (const text of ['', '<html/>', kEaf.slice(0, -30), '<ANNOTATION_DOCUMENT><TIER></ANNOTATION_DOCUMENT>'])
    expect(() => writeChecked(text, kReview, '')).toThrow('noEaf')
})

it('reads any encoding, and writes UTF-8 with the matching declaration', () => {
  const text = '<?xml version="1.0" encoding="ISO-8859-1"?><a b="é"/>'
  const latin = new Uint8Array([...text].map((c) => c.charCodeAt(0))).buffer
  expect(decoded(latin)).toBe(text)
  expect(new TextDecoder().decode(encoded(text))).toBe(text.replace('ISO-8859-1', 'UTF-8'))
  const wide = new Uint8Array(2 * text.length)
  ;[...text].forEach((c, i) => (wide[2 * i] = c.charCodeAt(0)))
  expect(decoded(wide.buffer)).toBe(text)
  const marked = '\ufeff<?xml version="1.0" encoding="utf-8"?><a/>'
  expect(decoded(new TextEncoder().encode(marked).buffer)).toBe(marked)
  expect(new TextDecoder('utf-8', { ignoreBOM: true }).decode(encoded(marked))).toBe(marked)
  expect(unescaped('&lt;&#233;&#xE9;&lol;&amp;lt;')).toBe('<éé&lol;&lt;')
})
