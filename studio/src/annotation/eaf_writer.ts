import { StudioFault } from '../api/fault'
import { edited, escaped, parseXml, type Edit, type Element } from './xml_text'

/** A tier that stands on its own; `type` is a name that asks nothing of its tiers. */
export interface NewTier {
  readonly name: string
  readonly type: string
  readonly annotator?: string
  readonly participant?: string
  readonly annotations: readonly { readonly begin: number; readonly end: number; readonly label: string }[]
}

/** The root element of an EAF. Throws where it is none. */
export function eafRoot(text: string): Element {
  const root = parseXml(text)
  if (root?.name !== 'ANNOTATION_DOCUMENT') throw new StudioFault('noEaf')
  return root
}

/**
 * Writes tiers into an EAF. Its bytes stay as they are, but for tiers that are taken out, new tiers, time slots in the order of time, tier types and
 * properties, and the number of the last annotation. `text` and `root` belong together.
 */
export class EafWriter {
  readonly tiers: readonly Element[]
  private readonly edits: Edit[] = []
  private readonly line: string
  private readonly header?: Element
  private readonly order?: Element
  private readonly newProperties: string[] = []
  private readonly newTiers: string[] = []
  private readonly newTypes = new Set<string>()
  private readonly newSlots: { id: string; time: number }[] = []
  private readonly gone = new Set<Element>()
  /** Of tiers that go. */
  private readonly freed = new Set<string>()
  private slot: number
  private annotation: number

  constructor(
    private readonly text: string,
    private readonly root = eafRoot(text),
  ) {
    this.line = text.includes('\r\n') ? '\r\n' : '\n'
    this.tiers = root.children.filter(({ name }) => name === 'TIER')
    this.header = root.children.find(({ name }) => name === 'HEADER')
    this.order = root.children.find(({ name }) => name === 'TIME_ORDER')
    this.slot = highest(
      this.slots().map(({ attributes }) => attributes.TIME_SLOT_ID),
      /^ts(\d+)$/,
    )
    this.annotation = Math.max(
      highest(
        this.annotations().map(({ attributes }) => attributes.ANNOTATION_ID),
        /^a(\d+)$/,
      ),
      Number(this.property('lastUsedAnnotationId')) || 0,
    )
  }

  /** What a property of the document says, as it is written there; none where it has none. */
  property(name: string): string | undefined {
    const known = this.propertyElement(name)
    return known && this.text.slice(known.inner, known.innerEnd)
  }
  setProperty(name: string, value: string): void {
    const known = this.propertyElement(name)
    if (known && known.inner < known.end) return void this.edits.push({ begin: known.inner, end: known.innerEnd, text: escaped(value) })
    this.newProperties.push(`${this.at(2)}<PROPERTY NAME="${escaped(name)}">${escaped(value)}</PROPERTY>`)
  }

  /** Adds a tier behind all others. */
  add({ name, type, annotator, participant, annotations }: NewTier): void {
    const made = annotations.map(({ begin, end, label }) => {
      const one = this.slotAt(begin),
        two = this.slotAt(end)
      return (
        `${this.at(2)}<ANNOTATION>${this.at(3)}<ALIGNABLE_ANNOTATION ANNOTATION_ID="a${++this.annotation}" TIME_SLOT_REF1="${one}" TIME_SLOT_REF2="${two}">` +
        `${this.at(4)}<ANNOTATION_VALUE>${escaped(label)}</ANNOTATION_VALUE>${this.at(3)}</ALIGNABLE_ANNOTATION>${this.at(2)}</ANNOTATION>`
      )
    })
    const attributes = [
      ['ANNOTATOR', annotator],
      ['LINGUISTIC_TYPE_REF', this.typeName(type)],
      ['PARTICIPANT', participant],
      ['TIER_ID', name],
    ]
    this.newTiers.push(
      `${this.at(1)}<TIER${attributes.flatMap(([key, value]) => (value ? ` ${key}="${escaped(value)}"` : [])).join('')}>${made.join('')}${this.at(1)}</TIER>`,
    )
  }
  /** Takes a tier out with the line that it stands on, and frees the slots that nobody else uses. */
  remove(tier: Element): void {
    this.gone.add(tier)
    this.edits.push({ begin: this.lineOf(tier.begin), end: tier.end, text: '' })
    const refs = (elements: readonly Element[]) => elements.flatMap(({ attributes }) => [attributes.TIME_SLOT_REF1, attributes.TIME_SLOT_REF2])
    const others = new Set(refs(this.tiers.filter((one) => one !== tier).flatMap((one) => this.annotations(one))))
    for (const id of refs(this.annotations(tier))) if (id && !others.has(id)) this.freed.add(id)
  }

  /** Whether a tier of this name was there, and is not taken out. */
  stays(name: string): boolean {
    return this.tiers.some((one) => one.attributes.TIER_ID === name && !this.gone.has(one))
  }

  /** The document with all of it. To be called once. */
  written(): string {
    this.writeSlots()
    const last = this.tiers.at(-1) ?? this.order ?? this.header
    const place = last?.end ?? this.root.inner
    if (this.newTiers.length > 0) {
      this.insert(place, this.newTiers.join(''))
      this.setProperty('lastUsedAnnotationId', String(this.annotation))
    }
    const types = [...this.newTypes].map(
      (name) => `${this.at(1)}<LINGUISTIC_TYPE GRAPHIC_REFERENCES="false" LINGUISTIC_TYPE_ID="${escaped(name)}" TIME_ALIGNABLE="true"/>`,
    )
    if (types.length > 0) this.insert(this.types().at(-1)?.end ?? place, types.join(''))
    const { header, newProperties } = this,
      before = header?.children.at(-1)
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
  private propertyElement(name: string): Element | undefined {
    return this.header?.children.find((one) => one.name === 'PROPERTY' && one.attributes.NAME === name)
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
    let next = 0,
      latest = -Infinity
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
  /** The wanted type, or one of its name that means the same; a name that is free where another has it. */
  private typeName(wanted: string): string {
    for (let number = 1; ; ++number) {
      const name = number > 1 ? `${wanted} ${number}` : wanted
      const known = this.types().find(({ attributes }) => attributes.LINGUISTIC_TYPE_ID === name)
      if (!known) this.newTypes.add(name)
      if (!known || isFree(known)) return name
    }
  }
}

/** Whether a tier type asks nothing of its tiers. */
const isFree = ({ attributes }: Element) => !attributes.CONSTRAINTS && !attributes.CONTROLLED_VOCABULARY_REF && attributes.TIME_ALIGNABLE !== 'false'
function highest(ids: readonly (string | undefined)[], pattern: RegExp): number {
  let most = 0
  for (const id of ids) most = Math.max(most, Number(pattern.exec(id ?? '')?.[1] ?? 0))
  return most
}
