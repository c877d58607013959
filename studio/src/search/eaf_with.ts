import { EafWriter } from '../annotation/eaf_writer'
import type { Answer } from './answers'

const kType = 'query answers'

/**
 * Adds answers of a query to an EAF on separate tiers: "query 1", "query 2" …, without overlaps on a tier, as `signweave query --format eaf` writes it.
 * Everything else is preserved byte for byte. Throws if the text is not an EAF.
 */
export function eafWith(text: string, answers: readonly Answer[]): string {
  const writer = new EafWriter(text)
  const names = new Set(writer.tiers.map(({ attributes }) => attributes.TIER_ID))
  const tiers: { end: number; readonly annotations: { begin: number; end: number; label: string }[] }[] = []
  for (const { name: label, begin, end } of answers.toSorted((a, b) => a.begin - b.begin)) {
    let tier = tiers.find((one) => one.end <= begin)
    if (!tier) tiers.push((tier = { end: 0, annotations: [] }))
    tier.end = end
    tier.annotations.push({ begin, end, label })
  }
  let number = 0
  for (const { annotations } of tiers) {
    do ++number
    while (names.has(`query ${number}`))
    writer.add({ name: `query ${number}`, type: kType, annotations })
  }
  return writer.written()
}
