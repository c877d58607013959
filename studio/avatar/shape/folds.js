// The drape of cloth: the trunk of the top hangs slightly away from the waist, and folds run over sleeves and trunk. The source's top is as smooth as a diving
// suit.
import { add, at, dot, length, normalsOf, scale, smoothstep, sub, unit } from './normals.js';

/** Returns smooth noise from three numbers, −1…1, without period over a body's size; identical on all machines. */
export function noise(x, y, z) {
  const cell = [Math.floor(x), Math.floor(y), Math.floor(z)];
  const f = [x - cell[0], y - cell[1], z - cell[2]].map((t) => t * t * t * (t * (t * 6 - 15) + 10));
  let sum = 0;
  for (let corner = 0; corner < 8; ++corner) {
    const bits = [corner & 1, (corner >> 1) & 1, corner >> 2];
    let share = 1;
    for (let k = 0; k < 3; ++k) share *= bits[k] ? f[k] : 1 - f[k];
    sum += share * hash(cell[0] + bits[0], cell[1] + bits[1], cell[2] + bits[2]);
  }
  return sum;
}

function hash(x, y, z) {
  let h = Math.imul(x, 374761393) ^ Math.imul(y, 668265263) ^ Math.imul(z, 1274126177);
  h = Math.imul(h ^ (h >>> 13), 1274126177);
  return ((h ^ (h >>> 16)) >>> 0) / 2147483648 - 1;
}

/** A fold: a narrow ridge where the noise crosses zero, flat elsewhere; 0…1. */
const ridge = (value) => Math.exp(-((value / 0.3) ** 2));

/**
 * Adds drape and folds to the top's offsets.
 * @param {import('./parts.js').Part} part
 * @param {Float64Array} points of the part
 * @param {Array<{ name: string, head: number[] }>} joints
 */
export function drape(part, points, joints) {
  const head = (name) => joints.find((joint) => joint.name === name).head;
  const normals = normalsOf(points, part.corners);
  const waist = head('spine03')[1] + 0.02;
  const chest = head('spine01')[1];
  const width = (y) => halfWidth(points, y);
  const hollow = Math.max(0, Math.min(width(chest - 0.1), width(waist - 0.12)) - width(waist));
  for (let i = 0; i < points.length / 3; ++i) {
    const p = at(points, i);
    const n = at(normals, i);
    const side = p[0] < 0 ? 'R' : 'L';
    const arm = alongArm(p, [`upperarm01_${side}`, `lowerarm01_${side}`, `wrist_${side}`].map(head));
    const sleeve = smoothstep(0.2, 0.6, arm.place);
    const mirrored = [Math.abs(p[0]), p[1], p[2]];
    const rise = sleeve * sleeveFold(arm, mirrored, side) + (1 - sleeve) * trunkFold(p, { waist, chest, hollow });
    for (let k = 0; k < 3; ++k) part.offsets[i * 3 + k] += n[k] * rise;
  }
}

/** Returns half the width of the trunk at a height, without sleeves, metres. */
function halfWidth(points, height) {
  let most = 0;
  for (let i = 0; i < points.length; i += 3) {
    if (Math.abs(points[i + 1] - height) < 0.012 && Math.abs(points[i]) < 0.2) most = Math.max(most, Math.abs(points[i]));
  }
  return most;
}

/** Returns the position of a point along the arm: 0 at the shoulder, 1 at the elbow, 2 at the wrist; and its side of the arm. */
function alongArm(p, [shoulder, elbow, wrist]) {
  const share = (a, b) => dot(sub(p, a), sub(b, a)) / length(sub(b, a)) ** 2;
  const upper = share(shoulder, elbow);
  const lower = share(elbow, wrist);
  const place = lower > 0 && upper > 0.9 ? 1 + Math.max(0, lower) : Math.min(1, Math.max(0, upper));
  const bone = place < 1 ? [shoulder, elbow] : [elbow, wrist];
  const foot = add(bone[0], scale(sub(bone[1], bone[0]), place < 1 ? place : place - 1));
  const inner = unit(sub(add(scale(shoulder, 0.5), scale(wrist, 0.5)), elbow));
  return { place, inside: dot(unit(sub(p, foot)), inner) };
}

/** Ends the sleeves square at the wrist: points beyond are moved back along the forearm, into a hem. */
export function trimSleeves(part, points, joints) {
  const end = 0.93; // fraction of the distance from elbow to wrist
  const head = (name) => joints.find((joint) => joint.name === name).head;
  for (let i = 0; i < points.length / 3; ++i) {
    const p = at(points, i);
    const side = p[0] < 0 ? 'R' : 'L';
    const [elbow, wrist] = [head(`lowerarm01_${side}`), head(`wrist_${side}`)];
    // Near the wrist, the forearm's direction is that of lowerarm02.
    const middle = head(`lowerarm02_${side}`);
    const along = unit(sub(wrist, middle));
    const beyond = dot(sub(p, wrist), along) + (1 - end) * length(sub(wrist, elbow));
    const near = length(sub(p, wrist)) < 0.12;
    if (near && beyond > -0.004) {
      const back = beyond + 0.004 - 0.004 * (1 - Math.exp(-(beyond + 0.004) / 0.004));
      for (let k = 0; k < 3; ++k) part.offsets[i * 3 + k] -= along[k] * back;
    }
  }
}

/** Folds gather where the arm bends and run across it at a slant; few elsewhere. None in the last centimetres, where the cuff fits. */
function sleeveFold({ place, inside }, [x, y, z], side) {
  const seed = side === 'L' ? 3.1 : 17.7;
  const elbow = Math.exp(-(((place - 1) / 0.34) ** 2));
  const across = noise(place * 5.5 + inside * 1.3, x * 6 + seed, (y + z) * 5);
  const loose = 1 - smoothstep(1.75, 1.92, place);
  return loose * (0.0012 + ridge(across) * (0.0016 + 0.0028 * elbow * (0.55 + 0.45 * inside)));
}

/** The trunk hangs from chest and shoulder blades; folds run down and inwards from the armpits, and gather above the hem. */
function trunkFold([x, y, z], { waist, chest, hollow }) {
  const hang = Math.exp(-(((y - waist) / 0.11) ** 2)) * (0.006 + 0.7 * hollow);
  const aside = Math.hypot(x, 0.04); // folds are symmetric, without a crease in the middle
  const slant = noise((y + aside * 1.3) * 13 + 5.3, (x - y * 0.5) * 4, z * 5);
  const low = 1 - smoothstep(chest - 0.12, chest + 0.06, y);
  const pit = smoothstep(0.07, 0.13, Math.abs(x)) * smoothstep(chest - 0.12, chest, y) * (1 - smoothstep(chest + 0.1, chest + 0.16, y));
  return hang + ridge(slant) * (0.0035 * low + 0.003 * pit);
}
