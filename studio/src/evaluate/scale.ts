/** Maps values to positions on a line, in pixels. */
export interface Scale {
  readonly at: (value: number) => number
  readonly ticks: readonly number[]
  readonly digits: number
}

/** Returns a scale over some values, starting from 0 if they are close to it; `log` if all are above 0. */
export function scaleOf(values: readonly number[], length: number, log: boolean, count = 5): Scale {
  const finite = values.filter(Number.isFinite)
  const low = Math.min(...finite),
    high = Math.max(...finite)
  if (finite.length === 0) return { at: () => 0, ticks: [], digits: 0 }
  if (log && low > 0) return logarithmic(low, high, length)
  const from = low < 0 ? low : 0,
    to = high > 0 ? high : 0
  const step = stepOf(to - from || 1, count)
  const first = Math.floor(from / step + 1e-9),
    last = Math.max(first + 1, Math.ceil(to / step - 1e-9))
  const begin = first * step,
    end = last * step
  return {
    at: (value) => ((value - begin) / (end - begin)) * length,
    ticks: Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step),
    digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)),
  }
}

function logarithmic(low: number, high: number, length: number): Scale {
  const from = Math.log10(low / 1.1),
    to = Math.log10(Math.max(high, low * 1.01) * 1.1)
  const ticks: number[] = []
  for (let power = Math.floor(from); power <= to; ++power) {
    for (const part of [1, 2, 5]) {
      const tick = part * 10 ** power,
        place = Math.log10(tick)
      if (place >= from && place <= to) ticks.push(tick)
    }
  }
  return {
    at: (value) => ((Math.log10(Math.max(value, 1e-300)) - from) / (to - from)) * length,
    ticks,
    digits: Math.max(0, -Math.floor(from)),
  }
}

/** Returns 1, 2 or 5 times a power of ten, which fits about `count` times into a range. */
function stepOf(range: number, count: number): number {
  const rough = range / count,
    power = 10 ** Math.floor(Math.log10(rough)),
    part = rough / power
  return (part <= 1 ? 1 : part <= 2 ? 2 : part <= 5 ? 5 : 10) * power
}

/** Moves overlapping labels apart as little as possible; the given order must be that of the positions. */
export function apart(places: readonly number[], least: number, low: number, high: number): readonly number[] {
  const out = [...places]
  for (let i = 0; i < out.length; ++i) out[i] = Math.max(out[i], i > 0 ? out[i - 1] + least : low)
  for (let i = out.length - 1; i >= 0; --i) out[i] = Math.min(out[i], i < out.length - 1 ? out[i + 1] - least : high)
  return out
}
