import { expect, it } from 'vitest'
import type { AnnotationDocument, Tier } from '../../annotation/document'
import { checkedTiers, isChecked, readChecked, rewritten, standOf, type Written } from './checked_tiers'
import { acceptedAll, decided, kEmpty, put, type Review } from './review'

const kAnnotation: AnnotationDocument = {
  tiers: [{ name: 'Gloss', depth: 0, participant: 'Zoé', annotations: [{ begin: 100, end: 300, label: 'A' }] }],
}
const accepted = (hand: 'right' | 'left', kind: string, begin: number, end: number) => ({ hand, kind, begin, end, state: 'accepted' as const })
const kReview: Review = [accepted('right', 'preparation', 50, 150), accepted('right', 'stroke', 150, 400), accepted('left', 'hold', 100, 300)].reduce(
  put,
  kEmpty,
)
/** The document that the server makes, as far as it is read again. */
function after({ tiers, properties }: AnnotationDocument, { changes }: Written): AnnotationDocument {
  const made = changes.tiers!.map(({ name, participant, annotations }): Tier => {
    const read = annotations.map(({ begin_ms, end_ms, label }) => ({ begin: begin_ms, end: end_ms, label }))
    return { name, participant, depth: 0, annotations: read }
  })
  return {
    tiers: [...tiers.filter(({ name }) => !changes.remove!.includes(name)), ...made],
    properties: { ...properties, ...Object.fromEntries(changes.properties!.map(({ name, value }) => [name, value])) },
  }
}

it('adds a tier for each hand, and says how its phases were checked', () => {
  const { changes, tiers } = checkedTiers(kAnnotation, kReview, 'A <b>')
  expect(tiers).toEqual([
    { hand: 'right', name: 'Phase RH (checked)', count: 2, unseen: 0 },
    { hand: 'left', name: 'Phase LH (checked)', count: 1, unseen: 0 },
  ])
  expect(changes).toEqual({
    remove: [],
    tiers: [
      {
        name: 'Phase RH (checked)',
        type: 'checked phase',
        annotator: 'signweave, checked by A <b>',
        participant: 'Zoé',
        annotations: [
          { begin_ms: 50, end_ms: 150, label: 'preparation' },
          { begin_ms: 150, end_ms: 400, label: 'stroke' },
        ],
      },
      {
        name: 'Phase LH (checked)',
        type: 'checked phase',
        annotator: 'signweave, checked by A <b>',
        participant: 'Zoé',
        annotations: [{ begin_ms: 100, end_ms: 300, label: 'hold' }],
      },
    ],
    properties: [
      {
        name: 'Phases (checked)',
        value: 'Phase RH (checked), Phase LH (checked): proposed by signweave from motion alone, each phase checked by A <b>',
      },
    ],
  })
})

it('names no signer if the tiers name several', () => {
  const two = { tiers: [...kAnnotation.tiers, { name: 'B', depth: 0, annotations: [] }] }
  expect(checkedTiers(two, kReview, '').changes.tiers!.map(({ participant }) => participant)).toEqual([undefined, undefined])
})

it('starts a second review from the written phases, and rewrites them', () => {
  const once = after(kAnnotation, checkedTiers(kAnnotation, kReview, ''))
  const read = readChecked(once)!
  expect([read.phases.right.map(({ kind, begin, end, state }) => [kind, begin, end, state]), read.phases.left.length]).toEqual([
    [
      ['preparation', 50, 150, 'accepted'],
      ['stroke', 150, 400, 'accepted'],
    ],
    1,
  ])
  const twice = checkedTiers(once, read, '')
  expect(twice.changes.remove).toEqual(['Phase RH (checked)', 'Phase LH (checked)'])
  expect(after(once, twice)).toEqual(once)
  expect(JSON.stringify(checkedTiers(once, decided(read, 1, 'rejected'), '').changes)).not.toMatch(/preparation/)
  // Tiers without phases are removed entirely.
  const none = checkedTiers(once, kEmpty, '')
  expect([none.tiers, none.changes.properties]).toEqual([[], [{ name: 'Phases (checked)', value: 'none' }]])
  expect(readChecked(after(once, none))).toBeUndefined()
})

it('writes under another name if other tiers depend on its own', () => {
  const once = after(kAnnotation, checkedTiers(kAnnotation, kReview, ''))
  const hung: AnnotationDocument = { ...once, tiers: [...once.tiers, { name: 'Note', parent: 'Phase RH (checked)', depth: 1, annotations: [] }] }
  const written = checkedTiers(hung, put(readChecked(hung)!, accepted('right', 'hold', 500, 600)), '')
  expect([written.tiers.map(({ name }) => name), written.changes.remove]).toEqual([['Phase RH (checked 2)', 'Phase LH (checked)'], ['Phase LH (checked)']])
  expect(readChecked(after(hung, written))!.phases.right.length).toBe(3)
  expect([isChecked('Phase LH (checked)'), isChecked('Phase LH (proposed)'), isChecked('Phase RH (checked 2)')]).toEqual(['left', undefined, 'right'])
})

it('preserves checked phases that someone else stored meanwhile', () => {
  const before = after(kAnnotation, checkedTiers(kAnnotation, kReview, 'A')),
    theirs = after(before, checkedTiers(before, decided(readChecked(before)!, 1, 'rejected'), 'B'))
  const [none, first, then] = [kAnnotation, before, theirs].map(standOf)
  expect([rewritten(first, then), rewritten(none, then), rewritten(first, none), rewritten(first, first)]).toEqual([['right'], ['right', 'left'], [], []])
  const written = checkedTiers(theirs, kReview, 'A', ['right'])
  expect([written.tiers.map(({ name }) => name), written.changes.remove]).toEqual([['Phase RH (checked 2)', 'Phase LH (checked)'], ['Phase LH (checked)']])
})

it('records which phases were accepted all at once, and reads this back', () => {
  const open = put(put(kReview, { ...accepted('right', 'hold', 400, 500), state: 'open' }), { ...accepted('left', 'hold', 300, 500), state: 'open' })
  const written = checkedTiers(kAnnotation, acceptedAll(open), 'Z')
  expect(written.tiers.map(({ unseen }) => unseen)).toEqual([1, 1])
  expect(written.changes.properties).toEqual([
    {
      name: 'Phases (checked)',
      value:
        'Phase RH (checked), Phase LH (checked): proposed by signweave from motion alone, 3 of 5 phases checked by Z, ' +
        '2 accepted all at once without being looked at',
    },
    { name: 'Phases (accepted unseen)', value: 'Phase RH (checked): 400; Phase LH (checked): 300' },
  ])
  expect(written.changes.tiers![0].annotator).toBe('signweave, partly checked by Z')
  const once = after(kAnnotation, written),
    read = readChecked(once)!
  expect([...read.phases.right, ...read.phases.left].map(({ unseen }) => unseen ?? false)).toEqual([false, false, true, false, true])
  // The other hand's entry stays with its tier.
  expect(checkedTiers(once, read, 'Z', ['left']).changes.properties![1].value).toBe(
    'Phase LH (checked): 300; Phase RH (checked): 400; Phase LH (checked 2): 300',
  )
  // After a person has looked at them and stored them, the file says so.
  const seen = checkedTiers(
    once,
    [3, 5].reduce((review, id) => decided(review, id, 'accepted'), read),
    'Z',
  )
  expect([seen.changes.properties![0].value.includes('each phase checked by Z'), seen.changes.properties![1].value]).toEqual([true, 'none'])
  expect(readChecked(after(once, seen))!.phases.right.some(({ unseen }) => unseen)).toBe(false)
})
