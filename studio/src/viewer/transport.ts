/** Seconds from frame 0; half-open. */
export interface Loop {
  readonly begin: number
  readonly end: number
}

export const kSlowest = 0.1
export const kFastest = 2

/** Seconds by which live playback stays behind the newest frame. */
const kBehind = 0.12

/** Playback: the current time in a motion, and how it advances. Independent of drawing. */
export class Transport {
  /** Seconds from frame 0. */
  time = 0
  playing = false
  /** The playback speed relative to the signing. */
  speed = 1
  /** Restarts at the end, or at the end of the loop. */
  repeat = false
  loop: Loop | null = null
  /** Seconds; grows while a stream arrives. */
  duration = 0
  /** Frames a second, for stepping. */
  rate = 100
  /** Follows the end of a motion that is still growing, in real time. */
  live = false
  /** More frames will come after the last: playback waits at the end instead of stopping. */
  growing = false
  /** Time stands still while this is set, because the frame for this time is still missing. Set by the drawing code. */
  held = false
  private last = 0

  /** Advances to `now` (ms of the page's clock). Returns whether the time changed. */
  tick(now: number): boolean {
    const elapsed = Math.min(0.25, Math.max(0, (now - this.last) / 1000))
    this.last = now
    if (!this.playing || elapsed === 0) return false
    if (this.live) return this.follow(elapsed)
    if (this.held) return false
    const begin = this.loop?.begin ?? 0,
      end = this.loop?.end ?? this.duration
    let time = this.time + elapsed * this.speed
    if (time >= end) {
      if (this.loop || (this.repeat && !this.growing)) time = end > begin ? begin + ((time - begin) % (end - begin)) : begin
      else {
        time = end
        this.playing = this.growing
      }
    }
    const moved = time !== this.time || !this.playing
    this.time = time
    return moved
  }

  /** Stays slightly behind the newest frame, so that playback never waits; catches up after the page was hidden. */
  private follow(elapsed: number): boolean {
    let time = this.time + elapsed
    if (time > this.duration || this.duration - time > kBehind * 4) time = Math.max(this.time > this.duration ? 0 : this.time, this.duration - kBehind)
    const moved = time !== this.time
    this.time = time
    return moved
  }

  play(): void {
    if (!this.loop && !this.live && !this.growing && this.time >= this.duration - 0.5 / this.rate) this.time = 0
    if (this.loop && (this.time < this.loop.begin || this.time >= this.loop.end)) this.time = this.loop.begin
    this.playing = true
  }

  pause(): void {
    this.playing = false
  }

  seek(seconds: number): void {
    this.time = Math.min(Math.max(0, seconds), this.duration)
  }

  /** Steps by whole frames, from the nearest one; stops playback. */
  step(frames: number): void {
    this.playing = false
    this.seek((Math.round(this.time * this.rate) + frames) / this.rate)
  }

  setSpeed(speed: number): void {
    this.speed = Math.min(kFastest, Math.max(kSlowest, Math.round(speed * 100) / 100))
  }

  /** Sets a span to repeat; clears the loop if it is shorter than a frame. */
  setLoop(begin: number, end: number): void {
    const low = Math.max(0, Math.min(begin, end)),
      high = Math.min(this.duration, Math.max(begin, end))
    this.loop = high - low >= 1 / this.rate ? { begin: low, end: high } : null
  }
}
