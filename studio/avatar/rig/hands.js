// The data about the hands at rest that a retargeter needs: palm normals, finger chains, axes of flexion and spread, limits.
import { add, cross, dot, length, scale, sub, unit } from '../shape/normals.js';

/**
 * Anatomical limits in degrees by finger and joint, knuckle first: flexion (negative: bent back) measured from the straight finger, and spread at the first
 * joint (positive: towards the thumb). For the thumb the first joint is the saddle joint at the wrist, whose flexion is measured from the rest pose. The upper
 * limits stop short of self-intersection of the skin.
 */
export const FINGER_LIMITS = {
  thumb: {
    flexion: [
      [-25, 40],
      [-10, 60],
      [-20, 80],
    ],
    spread: [-60, 35],
  },
  index: {
    flexion: [
      [-25, 92],
      [-2, 108],
      [-8, 78],
    ],
    spread: [-18, 22],
  },
  middle: {
    flexion: [
      [-25, 92],
      [-2, 110],
      [-8, 80],
    ],
    spread: [-16, 16],
  },
  ring: {
    flexion: [
      [-25, 92],
      [-2, 110],
      [-8, 80],
    ],
    spread: [-20, 16],
  },
  little: {
    flexion: [
      [-25, 95],
      [-2, 106],
      [-8, 78],
    ],
    spread: [-28, 18],
  },
};
/** Limits in degrees of the other joints of the arm, from the rest pose or, for the elbow, from the straight arm. */
export const ARM_LIMITS = {
  elbow: { flexion: [0, 150] },
  forearm: { twist: [-90, 90] },
  wrist: { flexion: [-75, 80], deviation: [-25, 40] },
};

const FINGERS = { thumb: 1, index: 2, middle: 3, ring: 4, little: 5 };
const degrees = (radians) => (radians * 180) / Math.PI;

/** @param {Array<{ name: string, head: number[], tail: number[] }>} joints @param {'L'|'R'} suffix */
export function describeHand(joints, suffix) {
  const joint = (name) => {
    const found = joints.find((each) => each.name === `${name}_${suffix}`);
    if (!found) throw new Error(`${name}_${suffix}: no such joint`);
    return found;
  };
  const wrist = joint('wrist').head;
  const knuckle = (finger) => joint(`finger${finger}_1`).head;
  const across = cross(sub(knuckle(2), wrist), sub(knuckle(5), wrist));
  const palmNormal = unit(suffix === 'L' ? scale(across, -1) : across);
  const middle = unit(sub(knuckle(3), wrist));
  const hand = {
    wrist: `wrist_${suffix}`,
    twist: [`lowerarm02_${suffix}`, `lowerarm01_${suffix}`],
    elbow: `lowerarm01_${suffix}`,
    shoulder: [`clavicle_${suffix}`, `shoulder01_${suffix}`, `upperarm01_${suffix}`, `upperarm02_${suffix}`],
    palmNormal,
    direction: middle,
    towardsThumb: unit(sub(knuckle(2), knuckle(5))),
    length: length(sub(joint('finger3_3').tail, wrist)),
    fingers: {},
  };
  for (const [name, number] of Object.entries(FINGERS)) {
    const chain = [1, 2, 3].map((k) => joint(`finger${number}_${k}`));
    hand.fingers[name] = describeFinger(name, number, chain, { suffix, palmNormal, wrist, towardsThumb: hand.towardsThumb });
  }
  return hand;
}

function describeFinger(name, number, chain, { suffix, palmNormal, wrist, towardsThumb }) {
  const bones = chain.map(({ head, tail }, k) => unit(sub(chain[k + 1]?.head ?? tail, head)));
  const thumb = name === 'thumb';
  // A finger bends in the plane of its three bones or, if it is too straight to determine this, in that of its knuckle and the palm.
  const inPalm = unit(cross(bones[0], palmNormal));
  const bend = add(cross(bones[0], bones[1]), cross(bones[1], bones[2]));
  const measured = thumb ? thumbAxis(chain, wrist) : unit(add(scale(inPalm, 0.35), bend));
  const axis = dot(measured, inPalm) < 0 && !thumb ? scale(measured, -1) : measured;
  const before = thumb ? bones[0] : flattened(unit(sub(chain[0].head, wrist)), axis);
  const restFlexion = bones.map((bone, k) => signedAngle(k === 0 ? before : bones[k - 1], bone, axis));
  if (thumb) restFlexion[0] = 0;
  return {
    joints: chain.map((each) => each.name),
    metacarpal: thumb ? null : `metacarpal${number - 1}_${suffix}`,
    tip: chain[2].tail,
    lengths: chain.map(({ head, tail }, k) => length(sub(chain[k + 1]?.head ?? tail, head))),
    flexionAxis: axis,
    // A positive rotation about this axis takes the finger towards the thumb's side.
    spreadAxis: unit(cross(bones[0], dot(axis, towardsThumb) > 0 ? axis : scale(axis, -1))),
    restFlexion: restFlexion.map(degrees),
    limits: FINGER_LIMITS[name],
  };
}

/** The thumb bends across the palm, in the plane of its own bones, rotated slightly so that its pad meets the fingers. */
function thumbAxis(chain, wrist) {
  const [a, b, c] = chain;
  const bend = cross(sub(b.head, a.head), sub(c.tail, b.head));
  const side = cross(sub(b.head, wrist), sub(c.tail, wrist));
  return length(bend) > 0.05 * length(sub(b.head, a.head)) * length(sub(c.tail, b.head)) ? unit(bend) : unit(side);
}

const flattened = (v, axis) => unit(sub(v, scale(axis, dot(v, axis))));

function signedAngle(from, to, axis) {
  const a = flattened(from, axis);
  const b = flattened(to, axis);
  return Math.atan2(dot(cross(a, b), axis), dot(a, b));
}
