// The metadata of the GLB in asset.extras.signweave, for programs that move the character. README.md explains each part.
import { ARM_LIMITS, describeHand } from './hands.js';
import { UNITS } from '../face/units.js';

/** @param {object} character of gather() */
export function extrasOf({ name, skeleton, parts, marks }) {
  const { joints } = skeleton;
  const head = (joint) => joints.find((each) => each.name === joint).head;
  const middle = (joint) => head(`${joint}_L`).map((value, k) => (value + head(`${joint}_R`)[k]) / 2);
  const top = Math.max(...parts.filter((part) => part.name === 'head').map((part) => highest(part.points)));
  const made = new Map();
  for (const part of parts) for (const unit of part.morphs.keys()) made.set(unit, [...(made.get(unit) ?? []), part.name]);
  return rounded({
    version: 1,
    character: name,
    space: { unit: 'metre', up: '+y', forward: '+z', left: '+x' },
    rest: 'every joint rotation is the identity, so that a joint turns about the axes of model space at rest',
    height: top,
    hipHeight: middle('upperleg01')[1],
    shoulderWidth: Math.abs(head('upperarm01_L')[0] - head('upperarm01_R')[0]),
    eyes: middle('eye'),
    mouth: [0, marks.mouthHeight, marks.faceDepth],
    hands: { left: describeHand(joints, 'L'), right: describeHand(joints, 'R') },
    limits: ARM_LIMITS,
    bones: Object.fromEntries(joints.map((joint) => [joint.name, { head: joint.head, tail: joint.tail }])),
    faceUnits: {
      morphs: Object.fromEntries([...made].sort(([a], [b]) => (a < b ? -1 : 1))),
      missing: Object.keys(UNITS)
        .filter((unit) => !made.has(unit))
        .sort(),
    },
  });
}

function highest(points) {
  let high = -Infinity;
  for (let i = 1; i < points.length; i += 3) high = Math.max(high, points[i]);
  return high;
}

/** Rounds numbers to a micrometre or a millionth, so that the text is short and identical on all machines. */
function rounded(value) {
  if (typeof value === 'number') return Math.round(value * 1e6) / 1e6 + 0;
  if (Array.isArray(value)) return value.map(rounded);
  if (value && typeof value === 'object') return Object.fromEntries(Object.entries(value).map(([key, each]) => [key, rounded(each)]));
  return value;
}
