import type { Annotation, AnnotationDocument } from '../../annotation/document'
import { kindOf, signTier } from '../../timeline/tier_kind'

/** Ms of annotation time; half-open. */
export interface Span {
  readonly begin: number
  readonly end: number
}
/** The transition between two signs. */
export interface Gap {
  readonly from: number
  readonly to: number
  /** `VANNES MATIN`. */ readonly signs: string
}

/** Shorter transitions are not perceptible; in longer ones the signer pauses. Ms. */
export const kShortest = 80
export const kLongest = 2500
/** The context on both sides of a gap that any method uses, ms. */
const kNeeded = 300

/**
 * Returns the annotated transitions as defined in docs/evaluation.md: from the end of one sign's last stroke to the begin of the next sign's first; in a
 * recording whose signs have no phases, the gaps between signs.
 */
export function gapsOf(document: AnnotationDocument): readonly Gap[] {
  const signs = signTier(document)
  if (!signs) return []
  const strokes = document.tiers
    .filter((tier) => tier !== signs && (tier.parent === undefined || tier.parent === signs.name))
    .filter(
      ({ name, depth, annotations }) =>
        annotations.length > 0 && 2 * annotations.filter(({ label }) => isPhase(name, depth, label)).length >= annotations.length,
    )
    .flatMap(({ name, depth, annotations }) => annotations.filter(({ label }) => kindOf(name, depth, label) === 'stroke'))
    .toSorted((a, b) => a.begin - b.begin)
  const edges = signs.annotations.map((sign) => (strokes.length > 0 ? strokesOf(sign, strokes) : sign))
  const gaps: Gap[] = []
  for (let i = 1; i < edges.length; ++i) {
    const before = edges[i - 1],
      after = edges[i]
    if (before && after && after.begin > before.end)
      gaps.push({ from: before.end, to: after.begin, signs: `${signs.annotations[i - 1].label} ${signs.annotations[i].label}` })
  }
  return gaps
}
const isPhase = (name: string, depth: number, label: string) => ['preparation', 'stroke', 'retraction'].includes(kindOf(name, depth, label))

/** Returns the span from the first stroke to the last of one sign, of either hand. */
function strokesOf({ begin, end }: Annotation, strokes: readonly Annotation[]): Span | undefined {
  let low = 0,
    high = strokes.length
  while (low < high) {
    const middle = (low + high) >> 1
    if (strokes[middle].begin < begin) low = middle + 1
    else high = middle
  }
  let last = -Infinity
  let first: number | undefined
  for (let i = low; i < strokes.length && strokes[i].begin < end; ++i) {
    first ??= strokes[i].begin
    last = Math.max(last, strokes[i].end)
  }
  return first === undefined ? undefined : { begin: first, end: last }
}

/** Returns the transitions that can be regenerated and judged: neither too short nor too long, with captured frames on both sides and no defect nearby. */
export function usable(gaps: readonly Gap[], captured: Span, broken: readonly Span[]): readonly Gap[] {
  return gaps.filter(
    ({ from, to }) =>
      to - from >= kShortest &&
      to - from <= kLongest &&
      from - kNeeded >= captured.begin &&
      to + kNeeded <= captured.end &&
      !broken.some(({ begin, end }) => begin < to + kNeeded && end > from - kNeeded),
  )
}

/** Returns the span shown: with `around` ms on both sides, as far as there is capture. */
export function shownOf({ from, to }: Gap, captured: Span, around: number): Span {
  return { begin: Math.max(Math.ceil(captured.begin), from - around), end: Math.min(Math.floor(captured.end), to + around) }
}
