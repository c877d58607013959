import type { AnnotationDocument } from '../../annotation/document'
import { eafRoot, EafWriter } from '../../annotation/eaf_writer'
import { escaped, unescaped, type Element } from '../../annotation/xml_text'
import { kEmpty, kHands, put, type Hand, type Phase, type Review } from './review'

/// Phases checked by a person, in an EAF: a separate tier for each hand next to the signs, like the proposals written by `signweave segment`. They need not
/// fill signs, so their tier cannot be a subdividing child of the sign tier; an import assigns them to signs by their times and by the hand in the tier name.

const kTier: Readonly<Record<Hand, string>> = { right: 'Phase RH (checked)', left: 'Phase LH (checked)' }
const kType = 'checked phase'
/** A property of the document; its name must not begin with `signweave:`, which marks declarations that recordings show on every view. */
const kProperty = 'Phases (checked)'
/** A property that lists the begins of phases that were accepted all at once, by tier, so that a continued review still shows which they are. */
const kUnseen = 'Phases (accepted unseen)'
const pattern = (hand: Hand) => new RegExp(`^Phase ${hand === 'right' ? 'RH' : 'LH'} \\(checked(?: (\\d+))?\\)$`)

export const isChecked = (tier: string): Hand | undefined => kHands.find((hand) => pattern(hand).test(tier))

/**
 * Returns the checked phases of a document, from the newest tier of each hand; undefined if it has none. `text` is the document's text, which records which
 * were accepted unseen.
 */
export function readChecked({ tiers }: AnnotationDocument, text = ''): Review | undefined {
  let review = kEmpty,
    any = false
  const unseen = new Map(text.includes(kUnseen) ? unseenIn(new EafWriter(text)) : [])
  for (const hand of kHands) {
    const tier = tiers.filter(({ name }) => pattern(hand).test(name)).sort((a, b) => numberOf(b.name) - numberOf(a.name))[0]
    any ||= tier !== undefined
    const passed = unseen.get(tier?.name ?? '')
    let end = 0
    for (const one of tier?.annotations ?? []) {
      const begin = Math.max(end, Math.round(one.begin))
      end = Math.max(begin, Math.round(one.end))
      if (end > begin) review = put(review, { hand, kind: one.label, begin, end, state: 'accepted', ...(passed?.includes(begin) ? { unseen: true } : {}) })
    }
  }
  return any ? review : undefined
}
function unseenIn(writer: EafWriter): readonly (readonly [tier: string, begins: readonly number[]])[] {
  return unescaped(writer.property(kUnseen) ?? '')
    .split('; ')
    .flatMap((one) => {
      const [, tier, begins] = /^(.+): ([\d ]+)$/.exec(one) ?? []
      return tier ? [[tier, begins.split(' ').map(Number)] as const] : []
    })
}
const numberOf = (name: string) => Number(/(\d+)\)$/.exec(name)?.[1] ?? 1)

/** What was written: the tier of each hand, and its number of phases. */
export interface Written {
  readonly text: string
  readonly tiers: readonly {
    readonly hand: Hand
    readonly name: string
    readonly count: number
    /** The number of phases that were accepted all at once. */ readonly unseen: number
  }[]
}

/** Context of a review for writing: hands whose tiers were written by someone else meanwhile, so that those stay and ours get another name. */
export interface WriteOptions {
  readonly hands?: readonly Hand[]
  /** The root of the text, if it is already parsed. */ readonly root?: Element
}

/**
 * Returns the document with the accepted phases. Its bytes are unchanged except for: the tiers written before, which are rewritten (under another name if other
 * tiers depend on them), new time slots in their places, a tier type, and properties. Throws if the text is not an EAF. `person` may be empty.
 */
export function writeChecked(text: string, review: Review, person: string, { hands = [], root = eafRoot(text) }: WriteOptions = {}): Written {
  const writer = new EafWriter(text, root)
  const made = kHands.flatMap((hand) =>
    writeHand(
      writer,
      hand,
      review.phases[hand].filter(({ state }) => state === 'accepted'),
      person,
      hands.includes(hand),
    ),
  )
  const names = made.map(({ name }) => name),
    unseen = made.filter(({ unseen }) => unseen.length > 0)
  if (names.length > 0 || writer.property(kProperty) !== undefined)
    writer.setProperty(kProperty, names.length > 0 ? `${names.join(', ')}: ${howChecked(made, person)}` : 'none')
  // The entries of tiers that stay are preserved.
  const others = unseenIn(writer).filter(([name]) => !names.includes(name) && writer.stays(name))
  const kept = [...others, ...unseen.map(({ name, unseen }) => [name, unseen] as const)].map(([name, begins]) => `${name}: ${begins.join(' ')}`).join('; ')
  if (kept || writer.property(kUnseen) !== undefined) writer.setProperty(kUnseen, kept || 'none')
  return { text: writer.written(), tiers: made.map(({ unseen, ...tier }) => ({ ...tier, unseen: unseen.length })) }
}

type Made = Omit<Written['tiers'][number], 'unseen'> & { /** Begins of phases that were accepted unseen. */ readonly unseen: readonly number[] }

/** Writes a hand's tier in place of the previous one; returns nothing if there are no phases. */
function writeHand(writer: EafWriter, hand: Hand, phases: readonly Phase[], person: string, keepExisting: boolean): readonly Made[] {
  const names = new Set(writer.tiers.map(({ attributes }) => attributes.TIER_ID))
  const ours = writer.tiers
    .filter(({ attributes }) => pattern(hand).test(attributes.TIER_ID))
    .sort((a, b) => numberOf(b.attributes.TIER_ID) - numberOf(a.attributes.TIER_ID))[0]
  let name = ours?.attributes.TIER_ID ?? kTier[hand]
  if (ours && (keepExisting || writer.tiers.some(({ attributes }) => attributes.PARENT_REF === name))) {
    let number = numberOf(name)
    while (names.has(name)) name = kTier[hand].replace(')', ` ${++number})`)
  } else if (ours) writer.remove(ours)
  if (phases.length === 0) return []
  const unseen = phases.filter((one) => one.unseen).map(({ begin }) => begin)
  const how = unseen.length === 0 ? 'checked' : unseen.length < phases.length ? 'partly checked' : 'accepted unseen'
  writer.add({
    name,
    type: kType,
    annotator: `signweave, ${how} by ${person || 'a person'}`,
    participant: ours?.attributes.PARTICIPANT ?? participantOf(writer.tiers),
    annotations: phases.map(({ begin, end, kind }) => ({ begin, end, label: kind })),
  })
  return [{ hand, name, count: phases.length, unseen }]
}

function howChecked(made: readonly Made[], person: string): string {
  const who = person || 'a person',
    all = made.reduce((sum, { count }) => sum + count, 0),
    unseen = made.reduce((sum, one) => sum + one.unseen.length, 0)
  if (unseen === 0) return `proposed by signweave from motion alone, each phase checked by ${who}`
  return `proposed by signweave from motion alone, ${all - unseen} of ${all} phases checked by ${who}, ${unseen} accepted all at once without being looked at`
}

/** Returns the signer, if all original tiers name the same one. */
function participantOf(tiers: readonly Element[]): string | undefined {
  const said = new Set(
    tiers
      .filter(({ attributes }) => !attributes.PARENT_REF && isChecked(attributes.TIER_ID) === undefined)
      .map(({ attributes }) => attributes.PARTICIPANT ?? ''),
  )
  return said.size === 1 ? [...said][0] || undefined : undefined
}

/** A short fingerprint of each hand's checked phases, which differs if they differ; empty if there are none. */
export type Stand = Readonly<Record<Hand, string>>
export function standOf({ tiers }: AnnotationDocument): Stand {
  const of = (hand: Hand) => {
    const ours = tiers.filter(({ name }) => pattern(hand).test(name))
    return ours.length > 0 ? `${ours.length} ${hashOf(JSON.stringify(ours.map(({ name, annotations }) => [name, annotations])))}` : ''
  }
  return { right: of('right'), left: of('left') }
}
function hashOf(text: string): string {
  let hash = 0x811c9dc5
  for (let i = 0; i < text.length; ++i) hash = Math.imul(hash ^ text.charCodeAt(i), 0x01000193)
  return (hash >>> 0).toString(36)
}
/** Returns the hands that have checked phases which differ from before. */
export const rewritten = (before: Stand, now: Stand): readonly Hand[] => kHands.filter((hand) => now[hand] !== '' && now[hand] !== before[hand])

/** Returns an empty document, for a recording without annotation. */
export function emptyEaf(motionFile: string, date: string): string {
  const file = escaped(motionFile)
  return `<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="" DATE="${date}" FORMAT="3.0" VERSION="3.0" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://www.mpi.nl/tools/elan/EAFv3.0.xsd">
    <HEADER MEDIA_FILE="" TIME_UNITS="milliseconds">
        <LINKED_FILE_DESCRIPTOR LINK_URL="./${file}" MIME_TYPE="application/octet-stream" RELATIVE_LINK_URL="./${file}"/>
        <PROPERTY NAME="lastUsedAnnotationId">0</PROPERTY>
    </HEADER>
    <TIME_ORDER/>
</ANNOTATION_DOCUMENT>
`
}
