import { frameBytes, kRotationUnit, kTranslationUnit, type FrameBlock } from './frames'
import { Kinematics } from './kinematics'
import { restPose, type Pose } from './pose'
import { chainTo, type Rig, type Skeleton } from './skeleton'

const kPageBits = 7
const kPageFrames = 1 << kPageBits

/** 128 frames in the layout of docs/stream.md, viewed as three number types. */
interface Page {
  readonly ints: Int32Array
  readonly floats: Float32Array
  readonly shorts: Int16Array
  /** 1 if the frame is loaded. */
  readonly there: Uint8Array
  /** The number of loaded frames. */
  count: number
}

/** The part of 128 frames that is stored permanently. */
interface Trace {
  /** 1 if the frame has arrived. */
  readonly came: Uint8Array
  /** [6 · frame]: left wrist, right wrist, metres, model space; NaN if the rig has no such joint. */
  readonly hands: Float32Array
  /** The number of frames that have arrived. */
  count: number
}

/**
 * The frames of a motion as far as they have arrived, in any order. Reading allocates nothing. An hour has too many to store all: pages of frames may be
 * dropped and fetched again, while the positions of the hands, which the curves show, stay.
 */
export class FrameStore {
  readonly skeleton: Skeleton
  /** Frames a second. */
  readonly rate: number
  /** For which hands `hand` has values; false if the rig has no such joint. */
  readonly hasHand: readonly [boolean, boolean]
  /** The number of frames of the motion; for a stream, the number received. */
  length: number
  /** The number of frames that have arrived, each counted once. */
  arrived = 0
  /** The number of frames stored. */
  held = 0
  private readonly pages: (Page | undefined)[] = []
  private readonly traces: (Trace | undefined)[] = []
  private readonly bytes: number
  private readonly kinematics: Kinematics
  private readonly scratch: Pose
  private readonly wrists: readonly [number, number]
  private readonly chain: readonly number[]
  private readonly moved: Int32Array

  constructor(skeleton: Skeleton, rate: number, rig: Rig, length = 0) {
    this.skeleton = skeleton
    this.rate = rate
    this.length = length
    this.bytes = frameBytes(skeleton)
    this.kinematics = new Kinematics(skeleton)
    this.scratch = restPose(skeleton)
    this.wrists = [rig.left_hand?.joint ?? -1, rig.right_hand?.joint ?? -1]
    this.hasHand = [this.wrists[0] >= 0, this.wrists[1] >= 0]
    const joints = new Set(this.wrists.flatMap((wrist) => (wrist < 0 ? [] : chainTo(skeleton, wrist))))
    this.chain = [...joints].sort((a, b) => a - b)
    this.moved = Int32Array.from(skeleton.translated)
  }

  /** Seconds from the first frame to the last. */
  get seconds(): number {
    return Math.max(0, this.length - 1) / this.rate
  }

  put(block: FrameBlock): void {
    const from = new Uint8Array(block.buffer, block.offset, block.count * this.bytes)
    for (let i = 0; i < block.count; ++i) {
      const frame = block.first + i
      const page = (this.pages[frame >> kPageBits] ??= this.page())
      const at = frame & (kPageFrames - 1)
      new Uint8Array(page.ints.buffer, at * this.bytes, this.bytes).set(from.subarray(i * this.bytes, (i + 1) * this.bytes))
      if (page.there[at]) continue
      page.there[at] = 1
      ++page.count
      ++this.held
      this.measure(frame)
    }
    this.length = Math.max(this.length, block.first + block.count)
  }

  /** Drops whole pages of frames before `frame`: a stream runs for hours, and that far back is never shown again. */
  forgetBefore(frame: number): void {
    for (let page = (frame >> kPageBits) - 1; page >= 0 && this.pages[page]; --page) this.forget(page)
  }

  /** Drops pages, the farthest from `frame` first, until at most `most` frames are stored. */
  keepAround(frame: number, most: number): void {
    const here = frame >> kPageBits
    for (let low = 0, high = this.pages.length - 1; this.held > most && (low < here - 1 || high > here + 1);) {
      if (here - low > high - here) this.forget(low++)
      else this.forget(high--)
    }
  }

  has(frame: number): boolean {
    const page = this.pages[frame >> kPageBits]
    return page !== undefined && page.there[frame & (kPageFrames - 1)] === 1
  }

  /** Returns the first frame at or after `frame` that is not stored, or `length`. */
  firstMissing(frame: number): number {
    let f = Math.max(0, frame)
    while (f < this.length && this.has(f)) f += this.pages[f >> kPageBits]!.count === kPageFrames ? kPageFrames - (f & (kPageFrames - 1)) : 1
    return Math.min(f, this.length)
  }

  /** Returns the first frame at or after `frame`, otherwise the first of all, that never arrived; `length` if all have. */
  firstNew(frame: number): number {
    for (const [from, end] of [
      [Math.max(0, frame), this.length],
      [0, Math.min(frame, this.length)],
    ]) {
      for (let f = from; f < end; ++f) {
        const trace = this.traces[f >> kPageBits]
        if (trace?.count === kPageFrames) f |= kPageFrames - 1
        else if (!trace?.came[f & (kPageFrames - 1)]) return f
      }
    }
    return this.length
  }

  /** Returns one coordinate of a wrist in metres: `hand` 0 is left, 1 right; `axis` 0 x, 1 y, 2 z. NaN if it has not arrived. */
  hand(frame: number, hand: 0 | 1, axis: 0 | 1 | 2): number {
    const trace = this.traces[frame >> kPageBits]
    const at = frame & (kPageFrames - 1)
    return trace && trace.came[at] ? trace.hands[6 * at + 3 * hand + axis] : NaN
  }

  /** Returns the speed of a wrist at a frame in metres a second, from the frames before and after it; NaN if these have not arrived. */
  speed(frame: number, hand: 0 | 1): number {
    const before = Math.max(0, frame - 1),
      after = Math.min(this.length - 1, frame + 1)
    const dx = this.hand(after, hand, 0) - this.hand(before, hand, 0)
    const dy = this.hand(after, hand, 1) - this.hand(before, hand, 1)
    const dz = this.hand(after, hand, 2) - this.hand(before, hand, 2)
    return (Math.sqrt(dx * dx + dy * dy + dz * dz) * this.rate) / Math.max(1, after - before)
  }

  /**
   * Interpolates the pose at a time in seconds from frame 0. If one of the two frames is missing, the nearest earlier one is used. Returns false, and leaves
   * the pose unchanged, if there is none.
   */
  sample(seconds: number, pose: Pose): boolean {
    const at = Math.min(Math.max(0, seconds * this.rate), Math.max(0, this.length - 1))
    let frame = Math.floor(at + 1e-6)
    let part = Math.max(0, at - frame)
    if (!this.has(frame)) {
      part = 0
      while (frame >= 0 && !this.has(frame)) --frame
      if (frame < 0) return false
    }
    this.read(frame, pose, 1, true)
    if (part > 1e-6 && this.has(frame + 1)) this.read(frame + 1, pose, part, false)
    this.normalize(pose)
    return true
  }

  /** Blends the pose towards a frame by `part`; `fresh` overwrites it. Rotations are put on one hemisphere and are not normalised yet. */
  private read(frame: number, pose: Pose, part: number, fresh: boolean): void {
    const page = this.pages[frame >> kPageBits]!
    const words = ((frame & (kPageFrames - 1)) * this.bytes) >> 2
    const { rotations, positions, tracks } = pose
    const keep = fresh ? 0 : 1 - part
    let word = words
    for (let t = 0; t < this.moved.length; ++t) {
      const j = 3 * this.moved[t]
      for (let k = 0; k < 3; ++k, ++word) positions[j + k] = keep * positions[j + k] + part * page.ints[word] * kTranslationUnit
    }
    for (let t = 0; t < tracks.length; ++t, ++word) tracks[t] = keep * tracks[t] + part * page.floats[word]
    let short = word << 1
    for (let j = 0; j < rotations.length; j += 4, short += 4) {
      const x = page.shorts[short] * kRotationUnit,
        y = page.shorts[short + 1] * kRotationUnit
      const z = page.shorts[short + 2] * kRotationUnit,
        w = page.shorts[short + 3] * kRotationUnit
      // q and -q are the same rotation: the blend takes the shorter arc.
      const dot = fresh ? 1 : rotations[j] * x + rotations[j + 1] * y + rotations[j + 2] * z + rotations[j + 3] * w
      const to = dot < 0 ? -part : part
      rotations[j] = keep * rotations[j] + to * x
      rotations[j + 1] = keep * rotations[j + 1] + to * y
      rotations[j + 2] = keep * rotations[j + 2] + to * z
      rotations[j + 3] = keep * rotations[j + 3] + to * w
    }
  }

  private normalize(pose: Pose): void {
    const q = pose.rotations
    for (let j = 0; j < q.length; j += 4) {
      const length = Math.sqrt(q[j] * q[j] + q[j + 1] * q[j + 1] + q[j + 2] * q[j + 2] + q[j + 3] * q[j + 3])
      if (length < 1e-6) {
        q[j] = q[j + 1] = q[j + 2] = 0
        q[j + 3] = 1
        continue
      }
      for (let k = 0; k < 4; ++k) q[j + k] /= length
    }
  }

  /** Stores the hand positions of a frame that has just arrived. */
  private measure(frame: number): void {
    const trace = (this.traces[frame >> kPageBits] ??= { came: new Uint8Array(kPageFrames), hands: new Float32Array(6 * kPageFrames), count: 0 })
    const at = frame & (kPageFrames - 1)
    if (trace.came[at]) return
    trace.came[at] = 1
    ++trace.count
    ++this.arrived
    this.read(frame, this.scratch, 1, true)
    this.normalize(this.scratch)
    this.kinematics.update(this.scratch, this.chain)
    for (let hand = 0; hand < 2; ++hand) {
      for (let k = 0; k < 3; ++k) {
        trace.hands[6 * at + 3 * hand + k] = this.wrists[hand] < 0 ? NaN : this.kinematics.positions[3 * this.wrists[hand] + k]
      }
    }
  }

  private forget(page: number): void {
    this.held -= this.pages[page]?.count ?? 0
    this.pages[page] = undefined
  }

  private page(): Page {
    const buffer = new ArrayBuffer(kPageFrames * this.bytes)
    return { ints: new Int32Array(buffer), floats: new Float32Array(buffer), shorts: new Int16Array(buffer), there: new Uint8Array(kPageFrames), count: 0 }
  }
}
