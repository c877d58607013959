import type { Report, ReportSign } from '../api/answers'
import type { Place } from './project'

/** Where a place lies in what was made, in seconds. */
export interface LaidPlace {
  readonly begin: number
  readonly end: number
  /** The clip that it is in: neighbours in a recording share one. */
  readonly clip: number
  /** One of a gloss, any number of a piece. */
  readonly signs: readonly ReportSign[]
}
/** What lies before a place: the transition as it was recorded, or one that was made, in seconds. */
export type Seam =
  | { readonly kind: 'kept'; readonly begin: number; readonly end: number }
  | {
      readonly kind: 'made'
      readonly begin: number
      readonly end: number
      readonly method: string
      /** Frames: m_i, m_j and p of Algorithm 1. */
      readonly retraction: number
      readonly preparation: number
      readonly blend: number
    }
/** What was made, place by place; before the first there is no seam. */
export interface Laid {
  readonly places: readonly LaidPlace[]
  readonly seams: readonly (Seam | undefined)[]
}

/** What is known of the places of a project from what was made last, which may have been another one: by the places' ids. */
export class Known {
  private readonly places = new Map<number, { readonly place: LaidPlace; readonly seam?: Seam; readonly before?: number }>()

  constructor(places: readonly Place[], laid: Laid) {
    places.forEach(({ id }, k) => this.places.set(id, { place: laid.places[k], seam: laid.seams[k], before: places[k - 1]?.id }))
  }
  place(id: number): LaidPlace | undefined {
    return this.places.get(id)?.place
  }
  /** The seam between two places, where they were neighbours then. */
  seam(id: number, before: number | undefined): Seam | undefined {
    const known = this.places.get(id)
    return known?.before === before ? known?.seam : undefined
  }
  /** The place that is signed at a time, in seconds. */
  at(seconds: number): number | undefined {
    for (const [id, { place }] of this.places) if (place.begin <= seconds && seconds < place.end) return id
    return undefined
  }
}

/** Where the places of an utterance lie, by the report of what was made of it. None where they are not the report's. */
export function laidOf(places: readonly Place[], report: Report): Laid | undefined {
  const { signs, stretches, junctions, frames_per_second: rate } = report
  if (signs.some(({ place }) => place >= places.length)) return undefined
  const laid: LaidPlace[] = []
  for (const [place, { kind }] of places.entries()) {
    const own = signs.filter((sign) => sign.place === place)
    const alone = stretches.find((stretch) => stretch.place === place)
    if (own.length === 0 && (kind === 'sign' || !alone)) return undefined
    laid.push({
      begin: own.length > 0 ? own[0].begin_ms / 1000 : alone!.frames.begin / rate,
      end: own.length > 0 ? own[own.length - 1].end_ms / 1000 : alone!.frames.end / rate,
      clip: own.length > 0 ? own[0].clip : alone!.clip,
      signs: own,
    })
  }
  return { places: laid, seams: laid.map((place, k) => (k === 0 ? undefined : seamOf(laid[k - 1], place))) }

  function seamOf(before: LaidPlace, after: LaidPlace): Seam | undefined {
    if (before.clip === after.clip) return { kind: 'kept', ...keptBetween(before, after) }
    const junction = junctions.find(({ to_clip }) => to_clip === after.clip)
    if (!junction) return undefined
    const { frames, method, retraction_frames: retraction, preparation_frames: preparation, blend_frames: blend } = junction
    return { kind: 'made', begin: frames.begin / rate, end: frames.end / rate, method, retraction, preparation, blend }
  }
}

/** From the end of the last stroke before to the begin of the first one after. */
function keptBetween(before: LaidPlace, after: LaidPlace): { begin: number; end: number } {
  const last = before.signs[before.signs.length - 1]?.phases?.findLast(({ kind }) => kind === 'stroke')
  const first = after.signs[0]?.phases?.find(({ kind }) => kind === 'stroke')
  return { begin: last ? last.end_ms / 1000 : before.end, end: first ? first.begin_ms / 1000 : after.begin }
}
