/** What ELAN holds, as the timeline draws it. Times are annotation time in ms. */
export interface Annotation {
  readonly begin: number
  readonly end: number
  readonly label: string
  /** Of one that somebody decides about: it is drawn so. */
  readonly state?: 'open' | 'accepted' | 'unseen' | 'rejected'
  /** The one that keys and buttons are about. */
  readonly current?: boolean
}
export interface Tier {
  readonly name: string
  /** Name of the parent tier, or none. */
  readonly parent?: string
  /** How far below a tier without parent: 0 for such a tier. */
  readonly depth: number
  /** In the order of time; those of a tier never overlap. */
  readonly annotations: readonly Annotation[]
}
export interface AnnotationDocument {
  readonly tiers: readonly Tier[]
}

/** The annotation of a tier at a time, by binary search; −1 where there is none. */
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

/** The annotation of a tier at a time, else the next one, else the last. */
export function annotationNear(tier: Tier, ms: number): Annotation | undefined {
  return tier.annotations[indexAt(tier, ms)] ?? tier.annotations.find(({ begin }) => begin > ms) ?? tier.annotations.at(-1)
}

/** The begin of the annotation that lies next after `ms` (direction 1) or before it (−1); none past the ends. */
export function nextBegin(tier: Tier, ms: number, direction: 1 | -1): number | undefined {
  const list = tier.annotations
  // Half a ms to either side is here: times of frames and of annotations are not rounded alike.
  if (direction > 0) return list.find(({ begin }) => begin > ms + 0.5)?.begin
  return list.findLast(({ begin }) => begin < ms - 0.5)?.begin
}
