/** Annotation as the timeline draws it: of an ELAN file, or of a result. Times are annotation time in ms. */
export interface Annotation {
  readonly begin: number
  readonly end: number
  readonly label: string
  /** The state of an annotation under review; it determines how it is drawn. */
  readonly state?: 'open' | 'accepted' | 'unseen' | 'rejected'
  /** Whether keys and buttons act on this annotation. */
  readonly current?: boolean
  /** What a lane shows here, which determines how it is drawn; without it, that follows from the tier and the label. */
  readonly kind?: LaneKind
  /** Where it comes from, in one line. */
  readonly detail?: string
}
/** `shared`: a clip that the whole body shows as well; `movement`: authored. */
export type LaneKind = 'clip' | 'shared' | 'transition' | 'hold' | 'movement'
export interface Tier {
  readonly name: string
  /** Name of the parent tier, if any. */
  readonly parent?: string
  /** The signer, if the file names one. */
  readonly participant?: string
  /** Number of ancestors: 0 for a tier without a parent. */
  readonly depth: number
  /** Ordered by time; annotations of one tier never overlap. */
  readonly annotations: readonly Annotation[]
}
export interface AnnotationDocument {
  readonly tiers: readonly Tier[]
  /** Values by name. */
  readonly properties?: Readonly<Record<string, string>>
}

/** Returns the index of the annotation at a time, by binary search; −1 if there is none. */
export function indexAt(tier: Tier, ms: number): number {
  let low = 0,
    high = tier.annotations.length
  while (low < high) {
    const middle = (low + high) >> 1
    if (tier.annotations[middle].end <= ms) low = middle + 1
    else high = middle
  }
  return low < tier.annotations.length && tier.annotations[low].begin <= ms ? low : -1
}

/** Returns the annotation at a time, otherwise the next one, otherwise the last. */
export function annotationNear(tier: Tier, ms: number): Annotation | undefined {
  return tier.annotations[indexAt(tier, ms)] ?? tier.annotations.find(({ begin }) => begin > ms) ?? tier.annotations.at(-1)
}

/** Returns the begin of the nearest annotation after `ms` (direction 1) or before it (−1); undefined past either end. */
export function nextBegin(tier: Tier, ms: number, direction: 1 | -1): number | undefined {
  const list = tier.annotations
  // Times within half a ms count as equal: frame times and annotation times are rounded differently.
  if (direction > 0) return list.find(({ begin }) => begin > ms + 0.5)?.begin
  return list.findLast(({ begin }) => begin < ms - 0.5)?.begin
}
