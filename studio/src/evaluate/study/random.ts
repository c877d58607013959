/** Pseudorandom numbers that are the same for the same seed on every machine (mulberry32, seeded by FNV-1a). */
export class Random {
  private state: number

  constructor(...seed: readonly (string | number)[]) {
    let hash = 0x811c9dc5
    for (const byte of new TextEncoder().encode(seed.join('\n'))) hash = Math.imul(hash ^ byte, 0x01000193)
    this.state = hash >>> 0
  }

  /** In [0, 1). */
  next(): number {
    this.state = (this.state + 0x6d2b79f5) >>> 0
    let t = this.state
    t = Math.imul(t ^ (t >>> 15), t | 1)
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61)
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296
  }

  /** An integer in [0, count). */
  below(count: number): number {
    return Math.floor(this.next() * count)
  }

  /** Returns the elements in random order (Fisher and Yates). */
  shuffled<T>(things: readonly T[]): T[] {
    const out = [...things]
    for (let i = out.length - 1; i > 0; --i) {
      const k = this.below(i + 1)
      ;[out[i], out[k]] = [out[k], out[i]]
    }
    return out
  }
}
