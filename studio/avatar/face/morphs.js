// Face units as displacements of each part's points.
import { apply } from '../shape/stencil.js';
import { add, at, rotated, smoothstep, sub } from '../shape/normals.js';
import { UNITS } from './units.js';
import { SHAPES } from './shapes.js';

/** A morph that moves no point of a part by more than this, metres, is left out of that part. */
const LEAST = 0.00005;
/** Half the width of the seam between a left and a right half, metres. */
const SEAM = 0.012;

/**
 * @param {object} character data gathered by build_character: base, targets, person, skeleton, parts
 * @returns {Map<string, Map<string, Float64Array>>} part name → unit name → three numbers a point, metres
 */
export function faceMorphs(character, parts) {
  const out = new Map();
  const { marks } = character;
  const targetSums = new Map(Object.entries(UNITS).map(([name, unit]) => [name, targetSum(character, unit.targets ?? {})]));
  for (const part of parts) {
    const own = new Map();
    const unit = (name) => {
      if (!own.has(name)) own.set(name, unitOnPart(UNITS[name], targetSums.get(name), part, character, marks, unit));
      return own.get(name);
    };
    for (const name of Object.keys(UNITS).sort()) unit(name);
    const kept = [...own].filter(([, moves]) => moves.some((value) => Math.abs(value) > LEAST));
    out.set(part.name, new Map(kept.sort(([a], [b]) => (a < b ? -1 : 1))));
  }
  return out;
}

/** Returns the sum of shape targets on the base mesh; `unit/x` is the expression unit x, mixed by origin. */
function targetSum({ targets, base, origins }, weights) {
  const sum = new Float64Array(base.points.length);
  const addTarget = (name, weight) => {
    const moves = targets.read(name);
    for (let i = 0; i < sum.length; ++i) sum[i] += weight * moves[i];
  };
  for (const [name, weight] of Object.entries(weights)) {
    if (!name.startsWith('unit/')) addTarget(name, weight);
    else for (const [origin, share] of Object.entries(origins)) addTarget(`expression/units/${origin}/${name.slice(5)}`, weight * share);
  }
  return sum;
}

function unitOnPart(unit, baseSum, part, { skeleton }, marks, other) {
  const { points } = part;
  let sum = apply(part.stencil, baseSum);
  if (unit.side) {
    const sign = unit.side === 'left' ? 1 : -1;
    sum = sum.map((value, i) => value * smoothstep(-SEAM, SEAM, sign * points[i - (i % 3)]));
  }
  for (const { joint, axis, degrees } of unit.turn ?? []) addTurn(sum, part, skeleton, joint, axis, (degrees * Math.PI) / 180);
  if (unit.shape) sum = SHAPES[unit.shape]({ part, points, sum, marks, unit: other });
  return sum;
}

/** Adds the displacement that the rotation of one joint causes to its points. */
function addTurn(sum, part, skeleton, jointName, axis, angle) {
  const joint = skeleton.joints.findIndex(({ name }) => name === jointName);
  if (joint < 0) throw new Error(`${jointName}: no such joint`);
  const { head } = skeleton.joints[joint];
  for (let i = 0; i < part.points.length / 3; ++i) {
    let share = 0;
    for (let k = i * 4; k < i * 4 + 4; ++k) if (part.skin.joints[k] === joint) share += part.skin.shares[k];
    if (share === 0) continue;
    const arm = sub(at(part.points, i), head);
    const move = sub(add(head, rotated(arm, axis, angle)), at(part.points, i));
    for (let k = 0; k < 3; ++k) sum[i * 3 + k] += share * move[k];
  }
}

/** Returns heights and depths of the face used by some shapes, metres, model space; from vertices of the base mesh. */
export function faceMarks({ base, targets }) {
  const lower = strongest(targets.read('mouth/mouth-lowerlip-middle-up'));
  const upper = strongest(targets.read('mouth/mouth-upperlip-middle-down'));
  const brow = strongest(targets.read('expression/units/caucasian/eyebrows-left-inner-up'));
  const y = (vertex) => base.points[vertex * 3 + 1];
  return { mouthHeight: (y(lower) + y(upper)) / 2, browHeight: y(brow), faceDepth: base.points[upper * 3 + 2] };
}

function strongest(moves) {
  let best = 0;
  let most = -1;
  for (let i = 0; i < moves.length; i += 3) {
    const size = moves[i] ** 2 + moves[i + 1] ** 2 + moves[i + 2] ** 2;
    if (size > most) [most, best] = [size, i / 3];
  }
  return best;
}
