import { Kinematics } from '../motion/kinematics'
import { restPose, type Pose } from '../motion/pose'
import type { OpenedMotion } from '../motion/source'

/** The maximum number of frames sampled. */
const kLooked = 40
/** Distances that are constant for a body, whatever its pose. */
const kKept = [
  ['left_upper_arm', 'right_upper_arm'],
  ['left_thigh', 'right_thigh'],
  ['pelvis', 'neck'],
  ['pelvis', 'head'],
] as const
/** The maximum ratio between such a distance at rest and as captured. */
const kNear = 1.3

/** Returns up to a fixed number of loaded frames, spread over all of them. */
export function someFrames({ store }: Pick<OpenedMotion, 'store'>): number[] {
  const here = Array.from({ length: store.length }, (_, frame) => frame).filter((frame) => store.has(frame))
  const step = Math.max(1, Math.floor(here.length / kLooked))
  return here.filter((_, i) => i % step === 0)
}

/**
 * Returns a pose in which a body can be measured and built: the rest pose, if it is plausible for a person. Some exporters write files whose joints at zero
 * rotation form a heap of bones; then it is the mean of the loaded frames, joint by joint.
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
