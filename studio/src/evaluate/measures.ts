import type { Estimate, Scores, Task } from './evaluation'

/** Which figure is best: the lowest, the one nearest to 1 (as a ratio) or to 0; undefined if it does not rate the method. */
export type Better = 'low' | 'one' | 'zero'
/** `measure` has the format of `figureOf`. */
export interface Measure {
  readonly measure: string
  readonly digits: number
  readonly better: Better
  readonly unit?: 'mm' | 'ms' | '°' | 'µs'
}

/** In the order of docs/evaluation.md, starting with the wrist error over slerp's, the most important one. */
export const kMeasures: readonly Measure[] = [
  { measure: 'wrist/slerp', digits: 3, better: 'low' },
  { measure: 'wrist', digits: 1, better: 'low', unit: 'mm' },
  { measure: 'wrist_shoulder_widths', digits: 4, better: 'low' },
  { measure: 'fingertips', digits: 2, better: 'low', unit: 'mm' },
  { measure: 'fingertips/hermite', digits: 3, better: 'low' },
  { measure: 'arm_joints', digits: 2, better: 'low', unit: '°' },
  { measure: 'finger_joints', digits: 2, better: 'low', unit: '°' },
  { measure: 'peak_speed_ratio', digits: 3, better: 'one' },
  { measure: 'abs_ln_peak_speed_ratio', digits: 3, better: 'low' },
  { measure: 'peak_time_error', digits: 1, better: 'low', unit: 'ms' },
  { measure: 'path_length_ratio', digits: 3, better: 'one' },
  { measure: 'abs_ln_path_length_ratio', digits: 3, better: 'low' },
  { measure: 'log_jerk_difference', digits: 3, better: 'zero' },
  { measure: 'abs_log_jerk_difference', digits: 3, better: 'low' },
  { measure: 'spectral_arc_difference', digits: 3, better: 'zero' },
  { measure: 'abs_spectral_arc_difference', digits: 3, better: 'low' },
  { measure: 'seam_velocity_jump_ratio', digits: 2, better: 'low' },
  { measure: 'seam_acceleration_jump_ratio', digits: 2, better: 'low' },
  { measure: 'onset_lag_error', digits: 1, better: 'low', unit: 'ms' },
  { measure: 'depth_beyond_captured', digits: 2, better: 'low', unit: 'mm' },
  { measure: 'captured_frames_changed', digits: 2, better: 'low' },
  { measure: 'microseconds', digits: 1, better: 'low', unit: 'µs' },
]
/** Measured before any method is applied, so the same for all of them. */
export const kDurations: readonly Measure[] = [
  { measure: 'duration_error', digits: 1, better: 'low', unit: 'ms' },
  { measure: 'duration_error_of_mean', digits: 1, better: 'low', unit: 'ms' },
]

/** Returns the measures for which a task has figures. */
export function measuresOf(task: Task): readonly Measure[] {
  const there = new Set<string>()
  for (const { hands } of task.groups) {
    for (const scores of Object.values(hands)) {
      for (const figures of Object.values(scores)) {
        for (const [name, { over_slerp, over_hermite }] of Object.entries(figures)) {
          there.add(name)
          if (over_slerp) there.add(`${name}/slerp`)
          if (over_hermite) there.add(`${name}/hermite`)
        }
      }
    }
  }
  return kMeasures.filter(({ measure }) => there.has(measure))
}

/** Returns the distance of a figure from the optimum; the smallest is best. */
export function farness(value: number, better: Better): number {
  return better === 'low' ? value : better === 'zero' ? Math.abs(value) : value > 0 ? Math.abs(Math.log(value)) : Infinity
}

/** Returns the methods with the best figure, without bounds; none if all are equal. */
export function bestOf(
  figures: readonly (readonly [method: string, figure: Estimate | undefined])[],
  better: Better,
  isBound: (method: string) => boolean,
): ReadonlySet<string> {
  const there = figures.flatMap(([method, figure]) =>
    typeof figure?.value === 'number' && !isBound(method) ? [{ method, far: farness(figure.value, better) }] : [],
  )
  const least = Math.min(...there.map(({ far }) => far))
  const best = there.filter(({ far }) => far === least)
  return new Set(best.length < there.length ? best.map(({ method }) => method) : [])
}

/** Returns the name of a column in a file. */
export const columnName = (measure: string) => measure.replace('/', ' over ')

/** Returns all methods in some scores. */
export const methodsIn = (scores: Scores | undefined) => Object.keys(scores ?? {})
