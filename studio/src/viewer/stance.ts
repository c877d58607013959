import { Kinematics } from '../motion/kinematics'
import { restPose, type Pose } from '../motion/pose'
import type { OpenedMotion } from '../motion/source'

/** Frames that are looked at. */
const kLooked = 40
/** Distances that a body keeps, whatever it does. */
const kKept = [
  ['left_upper_arm', 'right_upper_arm'],
  ['left_thigh', 'right_thigh'],
  ['pelvis', 'neck'],
  ['pelvis', 'head'],
] as const
/** As much longer or shorter than captured such a distance may be at rest. */
const kNear = 1.3

/** At most so many frames that are here, spread over all of them. */
export function someFrames({ store }: Pick<OpenedMotion, 'store'>): number[] {
  const here = Array.from({ length: store.length }, (_, frame) => frame).filter((frame) => store.has(frame))
  const step = Math.max(1, Math.floor(here.length / kLooked))
  return here.filter((_, i) => i % step === 0)
}

/**
 * A pose in which a body can be measured and drawn: rest, where it is that of a person. Exporters write files whose joints all turned
 * to zero are a heap of bones; then it is the mean of the frames that are here, joint by joint.
 */
export function stanceOf(motion: Pick<OpenedMotion, 'store' | 'rig'>): Pose {
  const { store, rig } = motion
  const rest = restPose(store.skeleton),
    frames = someFrames(motion)
  if (frames.length === 0) return rest
  const mean = restPose(store.skeleton),
    pose = restPose(store.skeleton)
  mean.rotations.fill(0)
  mean.positions.fill(0)
  for (const frame of frames) {
    store.sample(frame / store.rate, pose)
    for (let j = 0; j < store.skeleton.joints.length; ++j) {
      let same = 0
      for (let k = 0; k < 4; ++k) same += mean.rotations[4 * j + k] * pose.rotations[4 * j + k]
      for (let k = 0; k < 4; ++k) mean.rotations[4 * j + k] += (same < 0 ? -1 : 1) * pose.rotations[4 * j + k]
      for (let k = 0; k < 3; ++k) mean.positions[3 * j + k] += pose.positions[3 * j + k] / frames.length
    }
  }
  for (let j = 0; j < store.skeleton.joints.length; ++j) {
    const length = Math.hypot(...mean.rotations.subarray(4 * j, 4 * j + 4))
    for (let k = 0; k < 4; ++k) mean.rotations[4 * j + k] = length > 1e-6 ? mean.rotations[4 * j + k] / length : Number(k === 3)
  }
  const atRest = new Kinematics(store.skeleton),
    captured = new Kinematics(store.skeleton)
  atRest.update(rest)
  captured.update(mean)
  const distance = ({ positions: p }: Kinematics, a: number, b: number) => Math.hypot(...[0, 1, 2].map((k) => p[3 * a + k] - p[3 * b + k]))
  const odd = kKept.some(([one, other]) => {
    const a = rig[one]?.joint,
      b = rig[other]?.joint
    if (a === undefined || b === undefined) return false
    const ratio = (distance(atRest, a, b) + 1e-6) / (distance(captured, a, b) + 1e-6)
    return ratio > kNear || ratio < 1 / kNear
  })
  return odd ? mean : rest
}
