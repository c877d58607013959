import type { ReportClip } from '../api/schema'
import type { Text } from '../text/en'

/** Returns what output frames show of a clip. */
export function sourceOf(clip: ReportClip, { begin, end }: ReportClip['frames'], labels: Text): string {
  const { kept_frames, kept_from_recorded_frame: kept, recorded_frames_per_frame: step } = clip
  const from = kept - (kept_frames.begin - begin) * step,
    to = kept + (end - kept_frames.begin) * step
  const source = put(labels.madeSource, { clip: clip.clip, place: clip.place, recording: clip.recording, from: Math.round(from), to: Math.round(to) })
  return clip.mirrored ? put(labels.madeMirrored, { source }) : source
}

/** Puts values into a label; they may contain anything and are not substituted again. */
export const put = (text: string, values: Readonly<Record<string, string | number>>) =>
  text.replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole))
