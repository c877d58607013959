/** What of a motion is drawn: pictures by their number, and nothing else tells the time. */
export interface Moments {
  /** Seconds from the motion's first frame to each picture. */
  readonly seconds: Float64Array
  /** Seconds that all of it lasts. */
  readonly lasts: number
}

/** Of `frames` frames at `motionRate` a second, every moment that pictures at `rate` a second show: the first and as many as there are. */
export function everyMoment(frames: number, motionRate: number, rate: number): Moments {
  const count = Math.floor(((frames - 1) * rate) / motionRate + 1e-6) + 1
  return { seconds: Float64Array.from({ length: count }, (_, k) => k / rate), lasts: count / rate }
}

/** The moments asked for, in ms from the first frame. Throws where the motion has no such moment. */
export function chosenMoments(frames: number, motionRate: number, atMs: readonly number[]): Moments {
  const lasts = frames / motionRate
  for (const ms of atMs) {
    if (ms < 0 || ms > 1000 * lasts) throw new Error(`there is nothing at ${ms} ms: the motion lasts ${Math.round(1000 * lasts)} ms`)
  }
  return { seconds: Float64Array.from(atMs, (ms) => ms / 1000), lasts }
}

/** When a picture of a film is shown, in whole microseconds; from its number alone, so that nothing adds up. */
export function microsecondsOf(picture: number, rate: number): number {
  return Math.round((picture * 1e6) / rate)
}
