import type { Synthesis } from '../api/schema'
import type { Annotation, AnnotationDocument, Tier } from './document'
import { laneTiers } from './lanes'
import { en, type Text } from '../text/en'
import { put, sourceOf } from './made_source'

/**
 * Builds the annotation of a result from the report that comes with the frames: signs, phases, places, sources and junctions of the whole body as its EAF has
 * them, and, below the phases, the lanes that differ from the body and the authored movements.
 */
export function documentOf(report: Synthesis, labels: Text = en): AnnotationDocument {
  const { junctions, frames_per_second: rate } = report
  const signs = report.signs.filter(({ channel }) => channel === undefined),
    clips = report.clips.filter(({ channel }) => channel === undefined)
  const ms = (frame: number) => Math.round((1000 * frame) / rate)
  const phases = signs.flatMap((sign) => sign.phases).map((phase) => ({ begin: phase.begin_ms, end: phase.end_ms, label: named(phase.kind, labels) }))
  const tier = (name: string, annotations: readonly Annotation[], parent?: string): Tier => ({
    name,
    parent,
    depth: parent ? 1 : 0,
    annotations: annotations.filter(({ begin, end }) => begin < end),
  })
  return {
    tiers: [
      tier(
        'Gloss',
        signs.map(({ begin_ms, end_ms, gloss }) => ({ begin: begin_ms, end: end_ms, label: gloss })),
      ),
      tier('Phase', phases, 'Gloss'),
      ...laneTiers(report, labels),
      tier(
        'Place',
        signs.map(({ begin_ms, end_ms, place, clip }) => ({ begin: begin_ms, end: end_ms, label: put(labels.madePlace, { place, clip }) })),
        'Gloss',
      ),
      tier(
        'Source',
        clips.map((clip) => ({ begin: ms(clip.frames.begin), end: ms(clip.frames.end), label: sourceOf(clip, clip.frames, labels) })),
      ),
      tier(
        'Junction',
        junctions.map(({ from_clip: fromClip, to_clip: toClip, frames, method, from, to, retraction_frames, preparation_frames, blend_frames }) => {
          const begin = ms(frames.begin),
            end = ms(frames.end)
          const values = {
            fromClip,
            toClip,
            method,
            ms: end - begin,
            from,
            to,
            retraction: retraction_frames,
            preparation: preparation_frames,
            blend: blend_frames,
          }
          return { begin, end, label: put(labels.madeSeam, values) }
        }),
      ),
    ],
  }
}

function named(kind: string, labels: Text): string {
  return kind === 'preparation' || kind === 'stroke' || kind === 'retraction' ? labels[kind] : kind.charAt(0).toUpperCase() + kind.slice(1)
}
