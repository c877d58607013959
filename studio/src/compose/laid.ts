import type { Report, ReportSign } from '../api/answers'
import type { Place } from './project'

/** Where a place lies in what was made, in seconds. */
export interface LaidPlace {
  readonly begin: number
  readonly end: number
  /** Which stretches it begins and ends in: neighbours in a recording share one. */
  readonly stretch: number
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

/** Finds the places of an utterance in the report of what was made of it. None where they are not the report's. */
export function laidOf(places: readonly Place[], report: Report): Laid | undefined {
  const { signs, stretches, junctions, frames_per_second: rate } = report
  const laid: LaidPlace[] = []
  let sign = 0,
    stretch = -1
  for (const place of places) {
    const from = sign
    if (place.kind === 'sign') ++sign
    else while (sign < signs.length && isOf(place, signs[sign], signs[sign - 1], sign > from)) ++sign
    const own = signs.slice(from, sign)
    if (place.kind === 'sign' && own.length === 0) return undefined
    stretch = own.length > 0 ? stretchOf(own[0], report, stretch) : stretch + 1
    const whole = stretches[stretch]
    if (!whole) return undefined
    const begin = own.length > 0 ? own[0].begin_ms / 1000 : whole.frames.begin / rate
    const end = own.length > 0 ? own[own.length - 1].end_ms / 1000 : whole.frames.end / rate
    laid.push({ begin, end, stretch, signs: own })
  }
  if (sign !== signs.length) return undefined
  return { places: laid, seams: laid.map((place, k) => (k === 0 ? undefined : seamOf(laid[k - 1], place))) }

  function seamOf(before: LaidPlace, after: LaidPlace): Seam | undefined {
    if (before.stretch === after.stretch) return { kind: 'kept', ...keptBetween(before, after) }
    const junction = junctions[after.stretch - 1]
    if (!junction) return undefined
    const { frames, method, retraction_frames: retraction, preparation_frames: preparation, blend_frames: blend } = junction
    return { kind: 'made', begin: frames.begin / rate, end: frames.end / rate, method, retraction, preparation, blend }
  }
}

/** Whether a sign was recorded inside a piece, after the one before it. */
function isOf({ recording, from, to }: Extract<Place, { kind: 'piece' }>, sign: ReportSign, before: ReportSign | undefined, begun: boolean): boolean {
  const { begin_ms, end_ms } = sign.recorded
  return sign.recording === recording && begin_ms >= from && end_ms <= to && !(begun && before && begin_ms <= before.recorded.begin_ms)
}

/** The stretch, from `least` on, that keeps the middle of a sign's stroke. */
function stretchOf(sign: ReportSign, { stretches, frames_per_second: rate }: Report, least: number): number {
  const stroke = sign.phases?.find(({ kind }) => kind === 'stroke') ?? sign
  const frame = ((stroke.begin_ms + stroke.end_ms) / 2000) * rate
  for (let s = Math.max(0, least); s < stretches.length; ++s) if (frame < stretches[s].kept_frames.end + 0.5) return s
  return stretches.length - 1
}

/** From the end of the last stroke before to the begin of the first one after. */
function keptBetween(before: LaidPlace, after: LaidPlace): { begin: number; end: number } {
  const last = before.signs[before.signs.length - 1]?.phases?.findLast(({ kind }) => kind === 'stroke')
  const first = after.signs[0]?.phases?.find(({ kind }) => kind === 'stroke')
  return { begin: last ? last.end_ms / 1000 : before.end, end: first ? first.begin_ms / 1000 : after.begin }
}
