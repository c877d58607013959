import { StudioFault } from '../../api/fault'
import type { AnnotationDocument } from '../../annotation/document'
import { inOrder, kEmpty, kHands, put, type Hand, type Review } from './review'
import { edited, escaped, parseXml, type Edit, type Element } from './xml_text'

/// Phases that a person checked, in an EAF: for each hand a tier of its own, beside the signs, as `signweave segment` writes its proposals. They need not fill
/// signs, so they cannot be a child that subdivides them; an import finds by their times and by the hand in their name which signs they belong to.

const kTier: Readonly<Record<Hand, string>> = { right: 'Phase RH (checked)', left: 'Phase LH (checked)' }
const kType = 'checked phase'
/** A property of the document; its name must not begin with `signweave:`, for that is what recordings declare of themselves on every view. */
const kProperty = 'Phases (checked)'
const pattern = (hand: Hand) => new RegExp(`^Phase ${hand === 'right' ? 'RH' : 'LH'} \\(checked(?: (\\d+))?\\)$`)

export const isChecked = (tier: string): Hand | undefined => kHands.find((hand) => pattern(hand).test(tier))

/** The checked phases that a document has: the newest tier of each hand. None where it has none. */
export function readChecked({ tiers }: AnnotationDocument): Review | undefined {
  let review = kEmpty, any = false
  for (const hand of kHands) {
    const tier = tiers.filter(({ name }) => pattern(hand).test(name)).sort((a, b) => numberOf(b.name) - numberOf(a.name))[0]
    any ||= tier !== undefined
    let end = 0
    for (const one of tier?.annotations ?? []) {
      const begin = Math.max(end, Math.round(one.begin))
      end = Math.max(begin, Math.round(one.end))
      if (end > begin) review = put(review, { hand, kind: one.label, begin, end, state: 'accepted' })
    }
  }
  return any ? review : undefined
}
const numberOf = (name: string) => Number(/(\d+)\)$/.exec(name)?.[1] ?? 1)

/** What was written: the tier of each hand, and how many phases it has. */
export interface Written { readonly text: string; readonly tiers: readonly { readonly hand: Hand; readonly name: string; readonly count: number }[] }

/**
 * The document with the accepted phases. Its bytes stay as they are, but for: the tiers that this wrote before, which are written anew (under another name
 * where somebody hung tiers on them), new time slots in their places, a tier type, and two properties. Throws where it is no EAF. `person` may be empty.
 */
export function writeChecked(text: string, review: Review, person: string): Written {
  const root = parseXml(text)
  if (root?.name !== 'ANNOTATION_DOCUMENT') throw new StudioFault('noEaf')
  const writer = new Writer(text, root, person)
  const tiers = kHands.flatMap((hand) => {
    const phases = review.phases[hand].filter(({ state }) => state === 'accepted')
    return writer.tier(hand, phases.length > 0 ? phases : undefined)
  })
  return { text: writer.written(tiers.map(({ name }) => name)), tiers }
}

const kSchema = 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://www.mpi.nl/tools/elan/EAFv3.0.xsd"'
/** A document without anything, for a recording that has none. */
export function emptyEaf(motionFile: string, date: string): string {
  const file = escaped(motionFile)
  return `<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="" DATE="${date}" FORMAT="3.0" VERSION="3.0" ${kSchema}>
    <HEADER MEDIA_FILE="" TIME_UNITS="milliseconds">
        <LINKED_FILE_DESCRIPTOR LINK_URL="./${file}" MIME_TYPE="application/octet-stream" RELATIVE_LINK_URL="./${file}"/>
        <PROPERTY NAME="lastUsedAnnotationId">0</PROPERTY>
    </HEADER>
    <TIME_ORDER/>
</ANNOTATION_DOCUMENT>
`
}

interface Span { readonly begin: number; readonly end: number; readonly kind: string }

class Writer {
  private readonly edits: Edit[] = []
  private readonly line: string
  private readonly tiers: readonly Element[]
  private readonly header?: Element
  private readonly order?: Element
  private readonly newProperties: string[] = []
  private readonly newTiers: string[] = []
  private readonly newSlots: { id: string; time: number }[] = []
  /** Of tiers that go. */
  private readonly freed = new Set<string>()
  private slot: number
  private annotation: number

  constructor(private readonly text: string, private readonly root: Element, private readonly person: string) {
    this.line = text.includes('\r\n') ? '\r\n' : '\n'
    this.tiers = root.children.filter(({ name }) => name === 'TIER')
    this.header = root.children.find(({ name }) => name === 'HEADER')
    this.order = root.children.find(({ name }) => name === 'TIME_ORDER')
    this.slot = highest(this.slots().map(({ attributes }) => attributes.TIME_SLOT_ID), /^ts(\d+)$/)
    const used = this.property('lastUsedAnnotationId')
    this.annotation = Math.max(highest(this.annotations().map(({ attributes }) => attributes.ANNOTATION_ID), /^a(\d+)$/),
      used ? Number(text.slice(used.inner, used.innerEnd)) || 0 : 0)
  }

  /** Writes a hand's tier in place of what was written before; none where there is nothing to be written. */
  tier(hand: Hand, phases: readonly Span[] | undefined): Written['tiers'] {
    const names = new Set(this.tiers.map(({ attributes }) => attributes.TIER_ID))
    const ours = this.tiers.filter(({ attributes }) => pattern(hand).test(attributes.TIER_ID))
      .sort((a, b) => numberOf(b.attributes.TIER_ID) - numberOf(a.attributes.TIER_ID))[0]
    let name = ours?.attributes.TIER_ID ?? kTier[hand]
    if (ours && this.tiers.some(({ attributes }) => attributes.PARENT_REF === name)) {
      let number = numberOf(name)
      while (names.has(name)) name = kTier[hand].replace(')', ` ${++number})`)
    } else if (ours) this.remove(ours)
    if (!phases) return []
    const participant = ours?.attributes.PARTICIPANT ?? this.participant()
    const made = phases.map(({ begin, end, kind }) => {
      const one = this.slotAt(begin), two = this.slotAt(end)
      return `${this.at(2)}<ANNOTATION>${this.at(3)}<ALIGNABLE_ANNOTATION` +
        ` ANNOTATION_ID="a${++this.annotation}" TIME_SLOT_REF1="${one}" TIME_SLOT_REF2="${two}">` +
        `${this.at(4)}<ANNOTATION_VALUE>${escaped(kind)}</ANNOTATION_VALUE>${this.at(3)}</ALIGNABLE_ANNOTATION>${this.at(2)}</ANNOTATION>`
    })
    const annotator = `signweave, checked by ${this.person || 'a person'}`
    this.newTiers.push(`${this.at(1)}<TIER ANNOTATOR="${escaped(annotator)}" LINGUISTIC_TYPE_REF="${escaped(this.typeName())}"` +
      `${participant ? ` PARTICIPANT="${escaped(participant)}"` : ''} TIER_ID="${escaped(name)}">` +
      `${made.join('')}${this.at(1)}</TIER>`)
    return [{ hand, name, count: phases.length }]
  }

  written(names: readonly string[]): string {
    this.writeSlots()
    const last = this.tiers.at(-1) ?? this.order ?? this.header
    const place = last?.end ?? this.root.inner
    if (this.newTiers.length > 0) this.insert(place, this.newTiers.join(''))
    this.writeType(place)
    this.writeProperty('lastUsedAnnotationId', String(this.annotation), this.newTiers.length > 0)
    const said = names.length > 0 ? `${names.join(', ')}: proposed by signweave from motion alone, each phase checked by ${this.person || 'a person'}` : 'none'
    this.writeProperty(kProperty, said, names.length > 0 || this.property(kProperty) !== undefined)
    const { header, newProperties } = this, before = header?.children.at(-1)
    if (before) this.insert(before.end, newProperties.join(''))
    else if (header && newProperties.length > 0) this.openUp(header, newProperties.join(''), 1)
    return edited(this.text, this.edits)
  }

  private at(depth: number): string {
    return this.line + '    '.repeat(depth)
  }
  private insert(at: number, text: string): void {
    this.edits.push({ begin: at, end: at, text })
  }
  private slots(): readonly Element[] {
    return this.order?.children.filter(({ name }) => name === 'TIME_SLOT') ?? []
  }
  private annotations(tier?: Element): readonly Element[] {
    return (tier ? [tier] : this.tiers).flatMap(({ children }) => children).flatMap(({ children }) => children)
  }
  private property(name: string): Element | undefined {
    return this.header?.children.find((one) => one.name === 'PROPERTY' && one.attributes.NAME === name)
  }
  /** Who signs, where all tiers of their own say the same. */
  private participant(): string | undefined {
    const said = new Set(this.tiers.filter(({ attributes }) => !attributes.PARENT_REF
      && isChecked(attributes.TIER_ID) === undefined).map(({ attributes }) => attributes.PARTICIPANT ?? ''))
    return said.size === 1 ? [...said][0] || undefined : undefined
  }

  /** Takes a tier out with the line that it stands on, and frees the slots that nobody else uses. */
  private remove(tier: Element): void {
    this.edits.push({ begin: this.lineOf(tier.begin), end: tier.end, text: '' })
    const refs = (elements: readonly Element[]) => elements.flatMap(({ attributes }) => [attributes.TIME_SLOT_REF1, attributes.TIME_SLOT_REF2])
    const others = new Set(refs(this.tiers.filter((one) => one !== tier).flatMap((one) => this.annotations(one))))
    for (const id of refs(this.annotations(tier))) if (id && !others.has(id)) this.freed.add(id)
  }
  /** The end of the line before, where there are only blanks between. */
  private lineOf(at: number): number {
    let begin = at
    while (begin > 0 && /[ \t]/.test(this.text[begin - 1])) --begin
    if (this.text[begin - 1] === '\n') --begin
    if (this.text[begin - 1] === '\r') --begin
    return begin
  }

  private slotAt(time: number): string {
    const id = `ts${++this.slot}`
    this.newSlots.push({ id, time })
    return id
  }
  /** New slots stand before the first that is later, so that the order of time stays one. */
  private writeSlots(): void {
    const kept = this.slots()
    for (const one of kept) if (this.freed.has(one.attributes.TIME_SLOT_ID)) this.edits.push({ begin: this.lineOf(one.begin), end: one.end, text: '' })
    if (this.newSlots.length === 0) return
    const fresh = [...this.newSlots].sort((a, b) => a.time - b.time)
    const text = ({ id, time }: { id: string; time: number }) => `${this.at(2)}<TIME_SLOT TIME_SLOT_ID="${id}" TIME_VALUE="${time}"/>`
    let next = 0, latest = -Infinity
    for (const one of kept) {
      const time = Number(one.attributes.TIME_VALUE ?? NaN)
      if (!(time > latest)) continue
      latest = time
      const from = next
      while (next < fresh.length && fresh[next].time < time) ++next
      if (next > from) this.insert(this.lineOf(one.begin), fresh.slice(from, next).map(text).join(''))
    }
    const rest = fresh.slice(next).map(text).join('')
    if (!rest) return
    if (kept.length > 0) this.insert(kept.at(-1)!.end, rest)
    else if (this.order) this.openUp(this.order, rest, 1)
    else this.insert(this.header?.end ?? this.root.inner, `${this.at(1)}<TIME_ORDER>${rest}${this.at(1)}</TIME_ORDER>`)
  }
  /** Puts something into an element that is empty. */
  private openUp({ name, begin, end, inner, innerEnd }: Element, text: string, depth: number): void {
    if (inner < end) return void this.edits.push({ begin: inner, end: innerEnd, text: `${text}${this.at(depth)}` })
    const start = this.text.slice(begin, end).replace(/\s*\/>$/, '>')
    this.edits.push({ begin, end, text: `${start}${text}${this.at(depth)}</${name}>` })
  }

  private types(): readonly Element[] {
    return this.root.children.filter(({ name }) => name === 'LINGUISTIC_TYPE')
  }
  /** Our type, or one of its name that means the same; a name that is free where another has it. */
  private typeName(): string {
    const named = (name: string) => this.types().find(({ attributes }) => attributes.LINGUISTIC_TYPE_ID === name)
    let name = kType
    for (let number = 2; ; ++number) {
      const known = named(name)
      if (!known || isFree(known)) return name
      name = `${kType} ${number}`
    }
  }
  private writeType(place: number): void {
    const name = this.typeName(), types = this.types()
    if (this.newTiers.length === 0 || types.some(({ attributes }) => attributes.LINGUISTIC_TYPE_ID === name)) return
    this.insert(types.at(-1)?.end ?? place,
      `${this.at(1)}<LINGUISTIC_TYPE GRAPHIC_REFERENCES="false" LINGUISTIC_TYPE_ID="${escaped(name)}" TIME_ALIGNABLE="true"/>`)
  }

  private writeProperty(name: string, value: string, wanted: boolean): void {
    const known = this.property(name)
    if (!wanted) return
    if (known && known.inner < known.end) return void this.edits.push({ begin: known.inner, end: known.innerEnd, text: escaped(value) })
    this.newProperties.push(`${this.at(2)}<PROPERTY NAME="${escaped(name)}">${escaped(value)}</PROPERTY>`)
  }
}

/** Whether a tier type asks nothing of its tiers. */
const isFree = ({ attributes }: Element) => !attributes.CONSTRAINTS && !attributes.CONTROLLED_VOCABULARY_REF && attributes.TIME_ALIGNABLE !== 'false'
function highest(ids: readonly (string | undefined)[], pattern: RegExp): number {
  let most = 0
  for (const id of ids) most = Math.max(most, Number(pattern.exec(id ?? '')?.[1] ?? 0))
  return most
}

/** The phases that would be written, for a summary. */
export const writable = (review: Review) => inOrder(review).filter(({ state }) => state === 'accepted')
