import type { Synthesis } from '../api/schema'
import type { Annotation, AnnotationDocument, Tier } from '../annotation/document'

/** The labels of phases, places, sources and junctions, with placeholders `{…}`. */
export interface MadeLabels {
  readonly preparation: string
  readonly stroke: string
  readonly retraction: string
  readonly madePlace: string
  readonly madeSource: string
  readonly madeSeam: string
}
/** The labels used in the EAF. */
export const kEafLabels: MadeLabels = {
  preparation: 'Preparation',
  stroke: 'Stroke',
  retraction: 'Retraction',
  madePlace: '{place}, clip {clip}',
  madeSource: 'clip {clip}, place {place}: {recording} frames {from}..{to}',
  madeSeam: 'clip {fromClip} -> {toClip}: {method} {ms} ms: {from} -> {to} (m_i {retraction}, m_j {preparation}, p {blend})',
}

/** Builds the annotation of a result as its EAF has it, from the report that comes with the frames: signs, phases, places, sources, junctions. */
export function documentOf(report: Synthesis, labels: MadeLabels = kEafLabels): AnnotationDocument {
  const { signs, clips, junctions, frames_per_second: rate } = report
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
      tier(
        'Place',
        signs.map(({ begin_ms, end_ms, place, clip }) => ({ begin: begin_ms, end: end_ms, label: put(labels.madePlace, { place, clip }) })),
        'Gloss',
      ),
      tier(
        'Source',
        clips.map(({ clip, place, recording, frames, kept_frames, kept_from_recorded_frame: kept, recorded_frames_per_frame: step }) => {
          const from = kept - (kept_frames.begin - frames.begin) * step,
            to = kept + (frames.end - kept_frames.begin) * step
          return {
            begin: ms(frames.begin),
            end: ms(frames.end),
            label: put(labels.madeSource, { clip, place, recording, from: Math.round(from), to: Math.round(to) }),
          }
        }),
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

function named(kind: string, labels: MadeLabels): string {
  return kind === 'preparation' || kind === 'stroke' || kind === 'retraction' ? labels[kind] : kind.charAt(0).toUpperCase() + kind.slice(1)
}
/** Inserted values may contain anything and are not substituted again. */
const put = (text: string, values: Readonly<Record<string, string | number>>) =>
  text.replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole))
