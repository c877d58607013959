import type { ReportClip, ReportLane, ReportLaneItem, ReportMovement, Synthesis } from '../api/schema'
import type { Annotation, Tier } from './document'
import type { Text } from '../text/en'
import { put, sourceOf } from './made_source'

/** The order of the rows. */
const kAuthored = ['brows', 'gaze', 'lids', 'mouth', 'head'] as const

/** Returns a row for each channel that shows something else than the body, then one or more for each channel that authored movements move. */
export function laneTiers(report: Synthesis, labels: Text): readonly Tier[] {
  return [...(report.lanes ?? []).map((lane) => laneTier(lane, report, labels)), ...authoredTiers(report, labels)]
}

function laneTier({ channel, items }: ReportLane, report: Synthesis, labels: Text): Tier {
  const ms = msIn(report)
  const annotations = items.map((item, k) => ({ begin: ms(item.frames.begin), end: ms(item.frames.end), ...said(item, items, k, report, labels) }))
  return { name: labels[`lane_${channel}`], depth: 0, annotations: annotations.filter(({ begin, end }) => begin < end) }
}

function said(
  item: ReportLaneItem,
  items: readonly ReportLaneItem[],
  k: number,
  report: Synthesis,
  labels: Text,
): Pick<Annotation, 'label' | 'kind' | 'detail'> {
  const { frames, method = '' } = item
  if (item.kind === 'transition') {
    const values = { fromClip: item.from_clip ?? 0, toClip: item.to_clip ?? 0, method, ms: msIn(report)(frames.end - frames.begin) }
    return { label: method, kind: 'transition', detail: put(labels.madeLaneSeam, values) }
  }
  const clip = report.clips.find((one) => one.clip === item.clip)
  if (!clip) return { label: '', kind: 'clip' }
  if (item.kind === 'hold') {
    const before = items.slice(0, k).findLast((one) => one.kind === 'clip')
    const next = items[k + 1]
    const at = before ? before.frames.end - 1 : (next?.frames.begin ?? frames.end)
    const frame = Math.round(recordedFrame(clip, at))
    return {
      label: put(labels.madeHeld, { gloss: glossesOf(clip, { begin: at, end: at + 1 }, report) }),
      kind: 'hold',
      detail: put(labels.madeHeldSource, { clip: clip.clip, place: clip.place, recording: clip.recording, frame }),
    }
  }
  const isShared = clip.channel === undefined
  let detail = sourceOf(clip, frames, labels)
  if (item.hand_kept_in !== undefined) detail = put(labels.madeHand, { source: detail, space: item.hand_kept_in, mm: Math.round(item.hand_moved_mm ?? 0) })
  else if (isShared) detail = put(labels.madeAsBody, { source: detail })
  return { label: glossesOf(clip, frames, report), kind: isShared ? 'shared' : 'clip', detail }
}

/** Returns the glosses that a clip signs in a range of frames, or next to it; of a clip without signs the name of its recording. */
function glossesOf({ clip, recording }: ReportClip, frames: ReportLaneItem['frames'], report: Synthesis): string {
  const ms = msIn(report)
  const signs = report.signs.filter((sign) => sign.clip === clip)
  const inside = signs.filter(({ begin_ms, end_ms }) => begin_ms < ms(frames.end) && ms(frames.begin) < end_ms)
  const near = inside.length > 0 ? inside : [signs.findLast(({ begin_ms }) => begin_ms <= ms(frames.begin)) ?? signs[0]].filter(Boolean)
  return near.map(({ gloss }) => gloss).join(' ') || recording
}

/** Returns the rows of authored movements: each on every channel that it moves, and below each other where they overlap. */
function authoredTiers({ movements = [], ...report }: Synthesis, labels: Text): Tier[] {
  const sorted = movements.toSorted((a, b) => a.frames.begin - b.frames.begin)
  return kAuthored.flatMap((channel) => {
    const rows: Annotation[][] = []
    for (const one of sorted.filter(({ channels }) => channels.includes(channel))) {
      const annotation = movementOf(one, report, labels)
      const free = rows.find((row) => row[row.length - 1].end <= annotation.begin)
      if (free) free.push(annotation)
      else rows.push([annotation])
    }
    return rows.map((annotations, k): Tier => ({
      name: k === 0 ? labels[`authored_${channel}`] : `${labels[`authored_${channel}`]} ${k + 1}`,
      depth: 0,
      annotations,
    }))
  })
}

function movementOf({ name, kind, first_place, last_place, frames }: ReportMovement, report: Omit<Synthesis, 'movements'>, labels: Text): Annotation {
  const ms = msIn(report)
  const glosses = report.signs.filter(({ place, channel }) => channel === undefined && first_place <= place && place <= last_place).map(({ gloss }) => gloss)
  const label = kind === 'mouthing' ? `"${name}"` : name
  return {
    begin: ms(frames.begin),
    end: ms(frames.end),
    label,
    kind: 'movement',
    detail: put(labels.madeOver, { name: label, glosses: glosses.join(' ') }),
  }
}

const msIn =
  ({ frames_per_second: rate }: { readonly frames_per_second: number }) =>
  (frame: number) =>
    Math.round((1000 * frame) / rate)
const recordedFrame = ({ kept_frames, kept_from_recorded_frame: kept, recorded_frames_per_frame: step }: ReportClip, frame: number) =>
  kept + (frame - kept_frames.begin) * step
