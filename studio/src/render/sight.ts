import { PerspectiveCamera, type Vector3 } from 'three'
import type { OpenedMotion } from '../motion/source'
import { facingOf, type Facing } from '../viewer/facing'
import type { Proportions } from '../viewer/proportions'
import { Framing, windowOf, type Axes, type Stand } from './framing'
import { bustPoints, follow, handPoints, jointAlone } from './landmarks'
import type { RenderView } from './request'

/** Radii around a joint, metres of a signer of scale 1: flesh, and in a view of the hands some context. */
const kFlesh = 0.03,
  kAboutHands = 0.05
/** Seconds before and after a moment over which a view of the hands is smoothed. */
const kFollow = 0.35
/** Elevation of the camera in a view of the hands, radians. */
const kAbove = 0.12

/** The view of a sight: vertical field of view in degrees; pixels, of which `foot` at the bottom are covered. */
interface Picture {
  readonly lens: number
  readonly width: number
  readonly height: number
  readonly foot: number
}

/**
 * Returns the cameras that a view needs to show a whole motion, computed before the first frame is drawn: one sight, or one for each hand as seen from the
 * front, each in its part of the picture (`picture` gives its shape). Throws if there are no hands to show.
 */
export function sightsOf(motion: OpenedMotion, signer: Proportions, view: RenderView, picture: (shots: number) => Picture): Sight[] {
  const hands = (['right', 'left'] as const).map((side) => handPoints(motion, side)).filter(({ length }) => length > 0)
  const { scale } = signer,
    facing = facingOf(motion, signer)
  if (view === 'hands') {
    if (hands.length === 0) throw new Error('this motion’s rig has no hands: they cannot be shown')
    return hands.map(
      (hand) =>
        new Sight(motion, facing, view, picture(hands.length), (framing) =>
          framing.moving(follow(motion, hand), kAboutHands * scale, Math.round(kFollow * motion.store.rate)),
        ),
    )
  }
  const body = [...bustPoints(motion, signer), ...hands.flat()]
  const seen = follow(motion, body.length > 0 ? body : motion.store.skeleton.joints.map((_, joint) => jointAlone(joint)))
  return [
    new Sight(motion, facing, view, picture(1), (framing, { right }) => {
      // In the front view the body is centred, wherever the hands go; in the side view, everything visible is.
      const root = view === 'front' ? motion.rig.pelvis : undefined
      return [framing.still(seen, kFlesh * scale, root && meanAlong(follow(motion, [jointAlone(root.joint)]).places, right))]
    }),
  ]
}

/** A camera with precomputed positions, for each frame of a motion or a single one. */
export class Sight {
  readonly camera: PerspectiveCamera
  private readonly axes: Axes
  private readonly stands: readonly Stand[]
  private readonly rate: number

  constructor(
    { store }: OpenedMotion,
    private readonly signer: Facing,
    view: RenderView,
    { lens, width, height, foot }: Picture,
    stands: (framing: Framing, axes: Axes) => readonly Stand[],
  ) {
    this.camera = new PerspectiveCamera(lens, width / height, 0.05, 50)
    this.rate = store.rate
    this.axes = axesOf(signer, view)
    this.stands = stands(new Framing(this.axes, windowOf(lens, width, height, foot)), this.axes)
  }

  /** Returns the camera for a moment, in seconds from the motion's first frame. */
  at(seconds: number): PerspectiveCamera {
    const { camera, stands } = this,
      { right, up, back } = this.axes
    const at = Math.min(stands.length - 1, Math.max(0, seconds * this.rate)),
      frame = Math.floor(at)
    const from = stands[frame],
      to = stands[Math.min(stands.length - 1, frame + 1)]
    const between = (key: keyof Stand) => from[key] + (to[key] - from[key]) * (at - frame)
    camera.position.set(0, 0, 0).addScaledVector(right, between('right')).addScaledVector(up, between('up')).addScaledVector(back, between('back'))
    camera.up.copy(this.signer.up)
    camera.lookAt(camera.position.clone().sub(back))
    camera.updateMatrixWorld()
    return camera
  }
}

/** From the front, from the signer's right, or slightly from above. */
function axesOf(signer: Facing, view: RenderView): Axes {
  const level = view === 'side' ? signer.left.clone().negate() : signer.front.clone()
  const above = view === 'hands' ? kAbove : 0
  const back = level.multiplyScalar(Math.cos(above)).addScaledVector(signer.up, Math.sin(above)).normalize()
  const right = signer.up.clone().cross(back).normalize()
  return { right, up: back.clone().cross(right), back }
}

function meanAlong(places: Float32Array, axis: Vector3): number {
  let sum = 0
  for (let i = 0; i < places.length; i += 3) sum += axis.x * places[i] + axis.y * places[i + 1] + axis.z * places[i + 2]
  return (3 * sum) / places.length
}
