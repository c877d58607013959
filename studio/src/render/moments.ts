/** The moments of a motion to draw; frame numbers are the only measure of time. */
export interface Moments {
  /** Seconds from the motion's first frame to each frame drawn. */
  readonly seconds: Float64Array
  /** The total duration in seconds. */
  readonly lasts: number
}

/** Returns the moments at `rate` a second within `frames` frames at `motionRate` a second, starting with the first. */
export function everyMoment(frames: number, motionRate: number, rate: number): Moments {
  const count = Math.floor(((frames - 1) * rate) / motionRate + 1e-6) + 1
  return { seconds: Float64Array.from({ length: count }, (_, k) => k / rate), lasts: count / rate }
}

/** Returns the requested moments, given in ms from the first frame. Throws if one is outside the motion. */
export function chosenMoments(frames: number, motionRate: number, atMs: readonly number[]): Moments {
  const lasts = frames / motionRate
  for (const ms of atMs) {
    if (ms < 0 || ms > 1000 * lasts) throw new Error(`no frame at ${ms} ms: the motion lasts ${Math.round(1000 * lasts)} ms`)
  }
  return { seconds: Float64Array.from(atMs, (ms) => ms / 1000), lasts }
}

/** Returns the time of a video frame in whole microseconds, from its number alone, so that rounding errors do not accumulate. */
export function microsecondsOf(picture: number, rate: number): number {
  return Math.round((picture * 1e6) / rate)
}
