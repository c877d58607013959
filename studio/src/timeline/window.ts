/** The time span that the timeline shows, in seconds from frame 0, and its mapping to the screen. */
export class TimeWindow {
  begin = 0
  end = 1

  constructor(
    public duration = 1,
    public pixels = 1,
  ) {
    this.fit()
  }

  get span(): number {
    return this.end - this.begin
  }
  x(seconds: number): number {
    return ((seconds - this.begin) / this.span) * this.pixels
  }
  time(x: number): number {
    return this.begin + (x / this.pixels) * this.span
  }

  fit(): void {
    this.begin = 0
    this.end = Math.max(0.1, this.duration)
  }

  /** Zooms by a factor (above 1 zooms in); the moment at `about` stays in place. */
  zoom(factor: number, about: number): void {
    const span = Math.min(Math.max(0.1, this.duration), Math.max(0.1, this.span / factor))
    const part = Math.min(1, Math.max(0, (about - this.begin) / this.span))
    this.begin = about - part * span
    this.end = this.begin + span
    this.clamp()
  }

  move(seconds: number): void {
    this.begin += seconds
    this.end += seconds
    this.clamp()
  }

  /** Pages to a moment outside the window. Returns whether it did. */
  follow(seconds: number): boolean {
    if (seconds >= this.begin && seconds <= this.end) return false
    this.move(seconds - this.begin - 0.05 * this.span)
    return true
  }

  private clamp(): void {
    const { span } = this
    this.begin = Math.max(0, Math.min(this.begin, Math.max(0.1, this.duration) - span))
    this.end = this.begin + span
  }
}

/** Returns a tick distance of at least `least` seconds: 1, 2 or 5 times a power of ten. */
export function tickStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least))
  for (const factor of [1, 2, 5]) if (factor * power >= least - 1e-12) return factor * power
  return 10 * power
}
