import type { ReportSign, Synthesis } from '../api/schema'
import type { Place } from './project'

/** The position of a place in the result, in seconds. */
export interface PlacePosition {
  readonly begin: number
  readonly end: number
  /** The clip that contains it: neighbours from one recording share a clip. */
  readonly clip: number
  /** Exactly one for a gloss, any number for a piece. */
  readonly signs: readonly ReportSign[]
}
/** The transition before a place, as recorded or generated, in seconds. */
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
/** The result, place by place; there is no seam before the first. */
export interface PlaceLayout {
  readonly places: readonly PlacePosition[]
  readonly seams: readonly (Seam | undefined)[]
}

/** What the last result, perhaps of another project, says about the places of a project, by the places' ids. */
export class Known {
  private readonly places = new Map<number, { readonly place: PlacePosition; readonly seam?: Seam; readonly before?: number }>()

  constructor(places: readonly Place[], layout: PlaceLayout) {
    places.forEach(({ id }, k) => this.places.set(id, { place: layout.places[k], seam: layout.seams[k], before: places[k - 1]?.id }))
  }
  place(id: number): PlacePosition | undefined {
    return this.places.get(id)?.place
  }
  /** Returns the seam between two places if they were neighbours in that result. */
  seam(id: number, before: number | undefined): Seam | undefined {
    const known = this.places.get(id)
    return known?.before === before ? known?.seam : undefined
  }
  /** Returns the id of the place signed at a time, in seconds. */
  at(seconds: number): number | undefined {
    for (const [id, { place }] of this.places) if (place.begin <= seconds && seconds < place.end) return id
    return undefined
  }
}

/** Returns the positions of an utterance's places from the report of its result; undefined if the places do not match the report. */
export function layoutOf(places: readonly Place[], report: Synthesis): PlaceLayout | undefined {
  const { junctions, frames_per_second: rate } = report
  const signs = report.signs.filter(({ channel }) => channel === undefined),
    clips = report.clips.filter(({ channel }) => channel === undefined)
  if (signs.some(({ place }) => place >= places.length)) return undefined
  const layout: PlacePosition[] = []
  for (const [place, { kind }] of places.entries()) {
    const own = signs.filter((sign) => sign.place === place)
    const alone = clips.find((clip) => clip.place === place)
    if (own.length === 0 && (kind === 'sign' || !alone)) return undefined
    layout.push({
      begin: own.length > 0 ? own[0].begin_ms / 1000 : alone!.frames.begin / rate,
      end: own.length > 0 ? own[own.length - 1].end_ms / 1000 : alone!.frames.end / rate,
      clip: own.length > 0 ? own[0].clip : alone!.clip,
      signs: own,
    })
  }
  return { places: layout, seams: layout.map((place, k) => (k === 0 ? undefined : seamOf(layout[k - 1], place))) }

  function seamOf(before: PlacePosition, after: PlacePosition): Seam | undefined {
    if (before.clip === after.clip) return { kind: 'kept', ...keptBetween(before, after) }
    const junction = junctions.find(({ to_clip }) => to_clip === after.clip)
    if (!junction) return undefined
    const { frames, method, retraction_frames: retraction, preparation_frames: preparation, blend_frames: blend } = junction
    return { kind: 'made', begin: frames.begin / rate, end: frames.end / rate, method, retraction, preparation, blend }
  }
}

/** From the end of the last stroke before to the begin of the first one after. */
function keptBetween(before: PlacePosition, after: PlacePosition): { begin: number; end: number } {
  const last = before.signs[before.signs.length - 1]?.phases.findLast(({ kind }) => kind === 'stroke')
  const first = after.signs[0]?.phases.find(({ kind }) => kind === 'stroke')
  return { begin: last ? last.end_ms / 1000 : before.end, end: first ? first.begin_ms / 1000 : after.begin }
}
