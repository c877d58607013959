import { StudioFault } from '../api/fault'
import type { Answer } from './answers'

const kType = 'query answers'

/**
 * An EAF with answers of a query on tiers of their own beside what it holds: "query 1", "query 2" …, no two answers of one tier
 * overlapping, as `signweave query --format eaf` writes it. Throws where the text is no EAF.
 */
export function eafWith(text: string, answers: readonly Answer[]): string {
  const xml = new DOMParser().parseFromString(text, 'application/xml')
  const root = xml.documentElement
  const order = root.getElementsByTagName('TIME_ORDER')[0]
  if (root.nodeName !== 'ANNOTATION_DOCUMENT' || !order || xml.querySelector('parsererror')) throw new StudioFault('noEaf')
  const make = (name: string, attributes: Readonly<Record<string, string>>): Element => {
    const element = xml.createElement(name)
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value)
    return element
  }
  const taken = new Set([...root.getElementsByTagName('*')].flatMap((one) => ['TIME_SLOT_ID', 'ANNOTATION_ID'].flatMap((key) => one.getAttribute(key) ?? [])))
  const names = new Set([...root.getElementsByTagName('TIER')].map((tier) => tier.getAttribute('TIER_ID')))
  const free = (prefix: string): string => {
    for (let n = taken.size + 1; ; ++n) {
      if (taken.has(prefix + n)) continue
      taken.add(prefix + n)
      return prefix + n
    }
  }
  const types = root.getElementsByTagName('LINGUISTIC_TYPE')
  const firstType = types[0] ?? null
  const tiers: { readonly element: Element; end: number }[] = []
  for (const { name, begin, end } of answers.toSorted((a, b) => a.begin - b.begin)) {
    let tier = tiers.find((one) => one.end <= begin)
    if (!tier) {
      let number = tiers.length + 1
      while (names.has(`query ${number}`)) ++number
      names.add(`query ${number}`)
      tier = { element: make('TIER', { LINGUISTIC_TYPE_REF: kType, TIER_ID: `query ${number}` }), end: 0 }
      root.insertBefore(tier.element, firstType)
      tiers.push(tier)
    }
    tier.end = end
    const slots = [begin, end].map((time) => {
      const slot = make('TIME_SLOT', { TIME_SLOT_ID: free('ts'), TIME_VALUE: String(time) })
      order.append(slot)
      return slot.getAttribute('TIME_SLOT_ID')!
    })
    const annotation = make('ANNOTATION', {})
    const aligned = make('ALIGNABLE_ANNOTATION', { ANNOTATION_ID: free('a'), TIME_SLOT_REF1: slots[0], TIME_SLOT_REF2: slots[1] })
    const value = make('ANNOTATION_VALUE', {})
    value.textContent = name
    aligned.append(value)
    annotation.append(aligned)
    tier.element.append(annotation)
  }
  if (![...types].some((type) => type.getAttribute('LINGUISTIC_TYPE_ID') === kType)) {
    const type = make('LINGUISTIC_TYPE', { GRAPHIC_REFERENCES: 'false', LINGUISTIC_TYPE_ID: kType, TIME_ALIGNABLE: 'true' })
    root.insertBefore(type, types[types.length - 1]?.nextSibling ?? null)
  }
  const head = text.startsWith('<?xml') ? '' : '<?xml version="1.0" encoding="UTF-8"?>\n'
  return head + new XMLSerializer().serializeToString(xml)
}
