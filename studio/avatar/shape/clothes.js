// Clothes: kept clear of the skin, and closer to the arms than in the source.
import { add, at, dot, scale, sub, smoothstep } from './normals.js';

/** Least distance from skin to cloth, metres. */
export const CLEARANCE = 0.004;

/**
 * Moves a garment's points along the skin's normals: to at least CLEARANCE outside, and on the sleeves to only `looseness` times their distance beyond that.
 * @param {import('./parts.js').Part} part its offsets are changed
 * @param {Float64Array} points of the part
 * @param {{ points: Float64Array, normals: Float64Array, numbers: number[] }} skin
 * @param {(point: number[], skinPoint: number) => number} sleeve 1 on a sleeve, 0 elsewhere
 */
export function fitGarment(part, points, skin, sleeve, looseness = 0.35) {
  const count = points.length / 3;
  const wanted = new Float64Array(count * 3);
  const nearest = new Int32Array(count);
  for (let i = 0; i < count; ++i) {
    const p = at(points, i);
    const s = (nearest[i] = nearestSkin(p, skin));
    const n = at(skin.normals, s);
    const stand = dot(sub(p, at(skin.points, s)), n);
    const on = sleeve(p, s);
    const rest = CLEARANCE + Math.max(0, stand - CLEARANCE) * (1 - on * (1 - looseness));
    wanted.set(scale(n, rest - stand), i * 3);
  }
  let moves = wanted;
  for (let pass = 0; pass < 3; ++pass) moves = averaged(moves, part.corners, count);
  for (let i = 0; i < count; ++i) {
    // Smoothing may have moved a point too close again.
    const n = at(skin.normals, nearest[i]);
    const moved = add(at(points, i), at(moves, i));
    const stand = dot(sub(moved, at(skin.points, nearest[i])), n);
    const push = scale(n, Math.max(0, CLEARANCE - stand));
    for (let k = 0; k < 3; ++k) part.offsets[i * 3 + k] += moves[i * 3 + k] + push[k];
  }
}

function nearestSkin(p, skin) {
  let best = -1;
  let least = Infinity;
  for (const s of skin.numbers) {
    const dx = skin.points[s * 3] - p[0];
    const dy = skin.points[s * 3 + 1] - p[1];
    const dz = skin.points[s * 3 + 2] - p[2];
    const d = dx * dx + dy * dy + dz * dz;
    if (d < least) {
      least = d;
      best = s;
    }
  }
  return best;
}

function averaged(moves, corners, count) {
  const sum = Float64Array.from(moves, (value) => value * 2);
  const share = new Float64Array(count).fill(2);
  for (let f = 0; f < corners.length; f += 4) {
    for (let k = 0; k < 4; ++k) {
      const a = corners[f + k];
      const b = corners[f + ((k + 1) % 4)];
      for (let j = 0; j < 3; ++j) {
        sum[a * 3 + j] += moves[b * 3 + j] / 2;
        sum[b * 3 + j] += moves[a * 3 + j] / 2;
      }
      share[a] += 0.5;
      share[b] += 0.5;
    }
  }
  for (let i = 0; i < sum.length; ++i) sum[i] /= share[Math.floor(i / 3)];
  return sum;
}

/** Returns how closely cloth fits: 1 from the armpit outwards to the wrist and at the neck, 0 on the trunk. */
export function closeShare(weights, joints) {
  const arms = new Set(joints.flatMap((joint, j) => (/^(upperarm|lowerarm|wrist|neck)/.test(joint.name) ? [j] : [])));
  return (skinPoint) => {
    const share = weights[skinPoint].reduce((sum, [joint, w]) => sum + (arms.has(joint) ? w : 0), 0);
    return smoothstep(0.4, 0.9, share);
  };
}
