import type { Report } from '../api/answers'
import type { Annotation, AnnotationDocument, Tier } from '../annotation/document'

/** What was made as its EAF has it, from the report that comes with the frames: signs, phases, sources, junctions. */
export function documentOf(report: Report): AnnotationDocument {
  const { signs, stretches, junctions, frames_per_second: rate } = report
  const ms = (frame: number) => Math.round((1000 * frame) / rate)
  const phases = signs.flatMap((sign) => sign.phases ?? []).map((phase) => ({ begin: phase.begin_ms, end: phase.end_ms, label: named(phase.kind) }))
  const tier = (name: string, annotations: readonly Annotation[], parent?: string): Tier =>
    ({ name, parent, depth: parent ? 1 : 0, annotations: annotations.filter(({ begin, end }) => begin < end) })
  return {
    tiers: [
      tier('Gloss', signs.map(({ begin_ms, end_ms, gloss }) => ({ begin: begin_ms, end: end_ms, label: gloss }))),
      tier('Phase', phases, 'Gloss'),
      tier('Source', stretches.map(({ recording, frames, kept_frames, kept_from_recorded_frame: kept, recorded_frames_per_frame: step }) => {
        const from = kept - (kept_frames.begin - frames.begin) * step, to = kept + (frames.end - kept_frames.begin) * step
        return { begin: ms(frames.begin), end: ms(frames.end), label: `${recording} frames ${Math.round(from)}..${Math.round(to)}` }
      })),
      tier('Junction', junctions.map(({ frames, method, from, to, retraction_frames, preparation_frames, blend_frames }) => {
        const begin = ms(frames.begin), end = ms(frames.end)
        return { begin, end, label: `${method} ${end - begin} ms: ${from} -> ${to} (m_i ${retraction_frames}, m_j ${preparation_frames}, p ${blend_frames})` }
      })),
    ],
  }
}

const named = (kind: string) => kind.charAt(0).toUpperCase() + kind.slice(1)
