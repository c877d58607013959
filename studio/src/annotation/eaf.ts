import { StudioFault } from '../api/fault'
import type { Annotation, AnnotationDocument, Tier } from './document'

interface Raw {
  id: string
  tier: number
  begin?: number
  end?: number
  parent?: string
  previous?: string
  label: string
}
interface Span {
  begin: number
  end: number
}

/**
 * Reads an EAF. Annotations that take their time from a common parent annotation share its span evenly, in their order; time slots without a value are spaced
 * evenly between their neighbours of the same parent. Throws if the text is not an EAF.
 */
export function readEaf(text: string): AnnotationDocument {
  const xml = new DOMParser().parseFromString(text, 'application/xml')
  const root = xml.documentElement
  if (root.nodeName !== 'ANNOTATION_DOCUMENT' || xml.querySelector('parsererror')) throw new StudioFault('noEaf')
  const slots = timesOf(childrenOf(root, 'TIME_ORDER').flatMap((order) => childrenOf(order, 'TIME_SLOT')))
  const elements = childrenOf(root, 'TIER')
  const names = elements.map((tier) => tier.getAttribute('TIER_ID') ?? '')
  const parents = new Map(elements.map((tier, t) => [names[t], tier.getAttribute('PARENT_REF') ?? undefined]))
  const raw = new Map<string, Raw>()
  const byTier = elements.map((tier, t) => {
    const list = childrenOf(tier, 'ANNOTATION')
      .flatMap((one) => childrenOf(one))
      .map((one) => rawOf(one, t, slots))
    for (const one of list) raw.set(one.id, one)
    return list
  })
  const sharing = siblingsOf(byTier)
  const spans = new Map<Raw, Span>()
  const spanOf = (one: Raw): Span => {
    const known = spans.get(one)
    if (known) return known
    let span = { begin: one.begin ?? 0, end: one.end ?? one.begin ?? 0 }
    spans.set(one, span) // breaks a cycle of references
    const parent = one.parent ? raw.get(one.parent) : undefined
    if (parent) {
      const whole = spanOf(parent)
      const all = sharing.get(`${one.tier} ${one.parent}`)!
      const step = (whole.end - whole.begin) / all.size
      const at = all.get(one)!
      span = { begin: whole.begin + at * step, end: whole.begin + (at + 1) * step }
      spans.set(one, span)
    }
    return span
  }
  const tiers = elements.map((_, t): Tier => {
    const name = names[t]
    const annotations = byTier[t].map((one): Annotation => ({ ...spanOf(one), label: one.label }))
    const participant = elements[t].getAttribute('PARTICIPANT') || undefined
    return { name, parent: parents.get(name), participant, depth: depthOf(name, parents), annotations: annotations.sort((a, b) => a.begin - b.begin) }
  })
  const properties = childrenOf(root, 'HEADER').flatMap((header) => childrenOf(header, 'PROPERTY'))
  return {
    tiers: childrenAfterParents(tiers),
    properties: Object.fromEntries(properties.map((one) => [one.getAttribute('NAME') ?? '', one.textContent ?? ''])),
  }
}

/** Returns the child elements, optionally only those with a given name. Walks the children, because selectors take seconds for an hour of annotation. */
function childrenOf(element: Element, name?: string): Element[] {
  const found: Element[] = []
  for (let one = element.firstElementChild; one; one = one.nextElementSibling) if (!name || one.nodeName === name) found.push(one)
  return found
}

/** Returns the time of each slot, in file order; slots without a value are spaced evenly between the nearest slots that have one. */
function timesOf(slots: readonly Element[]): Map<string, number> {
  const times = slots.map((slot) => (slot.hasAttribute('TIME_VALUE') ? Number(slot.getAttribute('TIME_VALUE')) : NaN))
  for (let i = 0; i < times.length; ++i) {
    if (!Number.isNaN(times[i])) continue
    let end = i
    while (end < times.length && Number.isNaN(times[end])) ++end
    const before = times[i - 1] ?? 0
    const after = times[end] ?? before
    for (let k = i; k < end; ++k) times[k] = before + ((after - before) * (k - i + 1)) / (end - i + 1)
  }
  return new Map(slots.map((slot, i) => [slot.getAttribute('TIME_SLOT_ID') ?? '', times[i]]))
}

function rawOf(element: Element, tier: number, slots: ReadonlyMap<string, number>): Raw {
  const value = (name: string) => element.getAttribute(name) ?? undefined
  const label = childrenOf(element, 'ANNOTATION_VALUE')[0]?.textContent?.trim() ?? ''
  return {
    id: value('ANNOTATION_ID') ?? '',
    tier,
    label,
    parent: value('ANNOTATION_REF'),
    previous: value('PREVIOUS_ANNOTATION'),
    begin: slots.get(value('TIME_SLOT_REF1') ?? ''),
    end: slots.get(value('TIME_SLOT_REF2') ?? ''),
  }
}

/** Groups annotations by tier and parent, and numbers those that share a parent in their order. */
function siblingsOf(tiers: readonly (readonly Raw[])[]): Map<string, Map<Raw, number>> {
  const lists = new Map<string, Raw[]>()
  for (const one of tiers.flat()) {
    if (!one.parent) continue
    const list = lists.get(`${one.tier} ${one.parent}`)
    if (list) list.push(one)
    else lists.set(`${one.tier} ${one.parent}`, [one])
  }
  return new Map([...lists].map(([key, list]) => [key, new Map(inOrder(list).map((one, at) => [one, at]))]))
}

function inOrder(list: readonly Raw[]): readonly Raw[] {
  const after = new Map(list.map((one) => [one.previous ?? '', one]))
  const ordered = new Set<Raw>()
  for (let one = after.get(''); one && !ordered.has(one); one = after.get(one.id)) ordered.add(one)
  return ordered.size === list.length ? [...ordered] : list
}

function depthOf(name: string, parents: ReadonlyMap<string, string | undefined>): number {
  let depth = 0
  for (let parent = parents.get(name); parent !== undefined && depth < parents.size; parent = parents.get(parent)) ++depth
  return depth
}

function childrenAfterParents(tiers: readonly Tier[]): Tier[] {
  const ordered: Tier[] = []
  const visit = (tier: Tier) => {
    if (ordered.includes(tier)) return
    ordered.push(tier)
    tiers.filter((child) => child.parent === tier.name).forEach(visit)
  }
  tiers.filter((tier) => tier.depth === 0).forEach(visit)
  tiers.forEach(visit)
  return ordered
}
