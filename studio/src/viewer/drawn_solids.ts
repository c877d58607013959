import { Color, Vector3, type BufferGeometry } from 'three'
import type { Proportions } from './proportions'
import { SolidBuilder, type Detail, type Ring } from './solids'

const kSkin = new Color(0xd9a384)
const kHair = new Color(0x2b211d)
const kTop = new Color(0x33455a)
const kLegs = new Color(0x272f3a)
const kFingers = ['thumb', 'index', 'middle', 'ring', 'little'] as const
const kFingerRadius = { thumb: 0.0105, index: 0.0088, middle: 0.0092, ring: 0.0086, little: 0.0075 }

/** Builds the body of a signer from solids on its own skeleton: plain dark top, bare hands, as signers dress for video. */
export function drawnGeometry(p: Proportions, detail: Detail = 'fine'): BufferGeometry {
  const builder = new SolidBuilder(detail)
  if (p.joint('pelvis') >= 0 && p.joint('left_upper_arm') >= 0 && p.joint('right_upper_arm') >= 0) {
    torso(builder, p)
    head(builder, p)
    for (const side of ['left', 'right'] as const) {
      arm(builder, p, side)
      leg(builder, p, side)
    }
  } else anyBones(builder, p)
  return builder.geometry()
}

/** If the rig map contains too little, connects each joint to its parent, so that at least the bones are visible. */
function anyBones(builder: SolidBuilder, p: Proportions): void {
  p.skeleton.joints.forEach(({ parent }, j) => {
    if (parent < 0) return
    const a = p.ofJoint(parent),
      b = p.ofJoint(j)
    const radius = Math.min(0.04, Math.max(0.006, 0.14 * a.distanceTo(b)))
    builder.limb(a, b, radius, 0.8 * radius, parent, kTop)
  })
}

function torso(builder: SolidBuilder, p: Proportions): void {
  const pelvis = p.at('pelvis')!
  const shoulders = p.at('left_upper_arm')!.add(p.at('right_upper_arm')!).multiplyScalar(0.5)
  const neck = p.at('neck') ?? shoulders
  const s = p.scale
  // Joints between pelvis and neck, by height: each ring follows the two around it.
  const chain: { joint: number; height: number }[] = []
  for (let j = p.joint('neck') >= 0 ? p.joint('neck') : p.joint('head'); j >= 0; j = p.skeleton.joints[j].parent) {
    chain.unshift({ joint: j, height: p.ofJoint(j).sub(pelvis).dot(p.up) })
  }
  const carried = (height: number): { joints: [number, number]; part: number } => {
    let i = 0
    while (i + 1 < chain.length && chain[i + 1].height <= height) ++i
    const below = chain[i],
      above = chain[Math.min(i + 1, chain.length - 1)]
    if (!below) return { joints: [0, 0], part: 0 }
    const span = above.height - below.height
    return { joints: [below.joint, above.joint], part: span > 1e-4 ? Math.min(1, Math.max(0, (height - below.height) / span)) * 0.5 : 0 }
  }
  const top = shoulders.clone().sub(pelvis).dot(p.up)
  const toNeck = Math.max(top + 0.02 * s, neck.clone().sub(pelvis).dot(p.up))
  const ring = (height: number, side: number, front: number, shift: number): Ring => {
    const along = neck
      .clone()
      .sub(pelvis)
      .multiplyScalar(height / toNeck)
    return {
      at: pelvis
        .clone()
        .add(along)
        .addScaledVector(p.front, shift * s),
      side: side * s,
      front: front * s,
      ...carried(height),
    }
  }
  const rings = [
    ring(-0.115 * s, 0.02, 0.02, 0),
    ring(-0.118 * s, 0.16, 0.11, 0),
    ring(-0.11 * s, 0.187, 0.124, -0.004),
    ring(-0.06 * s, 0.186, 0.124, -0.006),
    ring(0.02 * s, 0.172, 0.115, -0.004),
    ring(0.3 * top, 0.148, 0.1, 0.004),
    ring(0.5 * top, 0.15, 0.104, 0.008),
    ring(0.7 * top, 0.164, 0.116, 0.006),
    ring(0.84 * top, 0.178, 0.118, 0),
    ring(0.95 * top, 0.185, 0.106, -0.004),
    ring(1.02 * top, 0.172, 0.088, -0.008),
    ring(1.09 * top, 0.118, 0.07, -0.006),
    ring(Math.max(1.13 * top, toNeck), 0.066, 0.06, 0),
    ring(Math.max(1.15 * top, toNeck + 0.012 * s), 0.055, 0.055, 0.002),
  ]
  // The top's hem is below the hips, over the legs.
  builder.loft(rings, p.left, p.front, kTop)
  const headAt = p.at('head')
  if (headAt) {
    const base = p.joint('neck') >= 0 ? p.joint('neck') : p.joint('head')
    builder.limb(p.from(neck, 0, -0.03, -0.004), p.from(headAt, 0, 0.03, 0.004), 0.056 * s, 0.051 * s, base, kSkin)
  }
}

/** Returns the centre and half axes of the head, which `face.ts` also needs. */
export function headShape(p: Proportions): { center: Vector3; radii: Vector3 } | undefined {
  const base = p.at('head')
  if (!base) return undefined
  const tip = p.at('head_top')
  const height = tip ? Math.max(0.12 * p.scale, tip.sub(base).dot(p.up)) : 0.19 * p.scale
  const half = 0.6 * height
  return {
    center: base
      .clone()
      .addScaledVector(p.up, height - half + 0.01 * p.scale)
      .addScaledVector(p.front, 0.13 * height),
    radii: new Vector3(0.66 * half, half, 0.8 * half),
  }
}

function head(builder: SolidBuilder, p: Proportions): void {
  const shape = headShape(p)
  if (!shape) return
  const joint = p.joint('head')
  const { center, radii } = shape
  // The face narrows to the chin, and the back of the skull is higher than the jaw.
  builder.ellipsoid(center, radii, p.left, p.up, joint, kSkin, (y) => ({
    side: y < 0 ? 1 - 0.2 * y * y : 1,
    front: y < 0 ? 1 - 0.12 * y * y : 1,
    shift: y < 0 ? -0.12 * y * y * -1 : 0,
  }))
  const hair = p.from(center, 0, 0.011, -0.011)
  const line = (at: Vector3): Color => {
    const away = at.clone().sub(center)
    return away.dot(p.front) > radii.z * 0.3 && away.dot(p.up) < radii.y * 0.62 ? kSkin : kHair
  }
  builder.ellipsoid(hair, radii.clone().multiply(new Vector3(1.05, 1.02, 1.0)), p.left, p.up, joint, line, (y) =>
    y < -0.35 ? { side: 0.55, front: 0.6, shift: -0.2 } : { side: 1, front: 1, shift: -0.03 },
  )
  for (const sign of [1, -1]) {
    const ear = center
      .clone()
      .addScaledVector(p.left, sign * radii.x * 1.03)
      .addScaledVector(p.up, -0.12 * radii.y)
      .addScaledVector(p.front, -0.12 * radii.z)
    builder.ellipsoid(ear, new Vector3(0.012, 0.03, 0.018).multiplyScalar(p.scale), p.left, p.up, joint, kSkin)
  }
  const nose = center
    .clone()
    .addScaledVector(p.front, radii.z * 0.97)
    .addScaledVector(p.up, -0.16 * radii.y)
  builder.limb(p.from(nose, 0, 0.026, -0.008), p.from(nose, 0, -0.004, 0.008), 0.006 * p.scale, 0.0115 * p.scale, joint, kSkin)
}

function arm(builder: SolidBuilder, p: Proportions, side: 'left' | 'right'): void {
  const s = p.scale
  const part = (name: string) => p.at(`${side}_${name}`)
  const joint = (name: string) => p.joint(`${side}_${name}`)
  const shoulder = part('upper_arm'),
    elbow = part('forearm'),
    wrist = part('hand')
  if (!shoulder || !elbow || !wrist) return
  const collar = part('clavicle')
  if (collar) builder.limb(collar.clone().lerp(shoulder, 0.35), shoulder, 0.05 * s, 0.057 * s, joint('clavicle'), kTop)
  builder.limb(shoulder, elbow, 0.056 * s, 0.044 * s, joint('upper_arm'), kTop)
  const cuff = elbow.clone().lerp(wrist, 0.86)
  builder.limb(elbow, cuff, 0.043 * s, 0.031 * s, joint('forearm'), kTop)
  builder.limb(elbow.clone().lerp(wrist, 0.7), wrist, 0.026 * s, 0.023 * s, joint('forearm'), kSkin)
  hand(builder, p, side, wrist)
}

function hand(builder: SolidBuilder, p: Proportions, side: 'left' | 'right', wrist: Vector3): void {
  const s = p.scale
  const carrier = p.joint(`${side}_hand`)
  const knuckles = kFingers.map((finger) => p.at(`${side}_${finger}_proximal`))
  const [, index, middle, , little] = knuckles
  if (!index || !middle || !little) {
    const elbow = p.at(`${side}_forearm`)!
    const end = wrist.clone().add(
      wrist
        .clone()
        .sub(elbow)
        .setLength(0.15 * s),
    )
    return builder.limb(wrist, end, 0.03 * s, 0.03 * s, carrier, kSkin)
  }
  // The palm: wide across the knuckles, thin along its normal.
  const across = index.clone().sub(little).normalize()
  const along = middle.clone().sub(wrist).normalize()
  across.addScaledVector(along, -across.dot(along)).normalize()
  const normal = along.clone().cross(across)
  const width = index.distanceTo(little) / 2 + 0.011 * s
  const center = index.clone().add(little).multiplyScalar(0.5)
  const carried = { joints: [carrier, carrier] as [number, number], part: 0 }
  const at = (t: number, shift = 0) =>
    wrist
      .clone()
      .lerp(center, t)
      .addScaledVector(across, shift * s)
  builder.loft(
    [
      { at: at(-0.12), side: 0.004 * s, front: 0.004 * s, ...carried },
      { at: at(-0.1), side: 0.019 * s, front: 0.016 * s, ...carried },
      { at: at(0.06), side: 0.024 * s, front: 0.018 * s, ...carried },
      { at: at(0.35, 0.002), side: 0.88 * width, front: 0.0165 * s, ...carried },
      { at: at(0.7), side: width, front: 0.015 * s, ...carried },
      { at: at(0.97), side: 0.96 * width, front: 0.0115 * s, ...carried },
      { at: at(1.06), side: 0.82 * width, front: 0.005 * s, ...carried },
      { at: at(1.07), side: 0.1 * width, front: 0.001 * s, ...carried },
    ],
    across,
    normal,
    kSkin,
  )
  kFingers.forEach((finger, f) => {
    const points = ['proximal', 'intermediate', 'distal', 'tip'].map((name) => p.at(`${side}_${finger}_${name}`))
    const joints = ['proximal', 'intermediate', 'distal'].map((name) => p.joint(`${side}_${finger}_${name}`))
    const radius = kFingerRadius[finger] * s
    if (knuckles[f])
      builder.limb(
        at(finger === 'thumb' ? 0.12 : 0.5, finger === 'thumb' ? 0.012 : 0).lerp(knuckles[f], finger === 'thumb' ? 0.1 : 0.3),
        knuckles[f],
        radius * 1.3,
        radius * 1.1,
        carrier,
        kSkin,
      )
    for (let i = 0; i < 3; ++i) {
      const a = points[i]
      if (!a || joints[i] < 0) continue
      const b =
        points[i + 1] ??
        (points[i - 1]
          ? a.clone().add(
              a
                .clone()
                .sub(points[i - 1]!)
                .multiplyScalar(0.7),
            )
          : undefined)
      if (!b) continue
      // A tip is the end of the flesh: the round end must not extend beyond it.
      const tip = points[i + 1] && i < 2 ? b : b.clone().addScaledVector(b.clone().sub(a).normalize(), -radius * 0.7)
      builder.limb(a, tip, radius * (1.08 - 0.09 * i), radius * (0.99 - 0.09 * i), joints[i], kSkin)
    }
  })
}

function leg(builder: SolidBuilder, p: Proportions, side: 'left' | 'right'): void {
  const s = p.scale
  const hip = p.at(`${side}_thigh`),
    knee = p.at(`${side}_shin`),
    ankle = p.at(`${side}_foot`)
  if (!hip || !knee || !ankle) return
  builder.limb(p.from(hip, 0, -0.02, 0), knee, 0.086 * s, 0.056 * s, p.joint(`${side}_thigh`), kLegs)
  builder.limb(knee, ankle, 0.054 * s, 0.036 * s, p.joint(`${side}_shin`), kLegs)
  const toes = p.at(`${side}_toes`) ?? p.from(ankle, 0, -0.07, 0.12)
  builder.limb(p.from(ankle, 0, -0.045, -0.03), p.from(toes, 0, 0.005, 0.05), 0.038 * s, 0.03 * s, p.joint(`${side}_foot`), kHair)
}
