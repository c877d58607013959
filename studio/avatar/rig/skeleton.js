// The character's joints, from the source's bones. Bones of the toes, the breast and the face's muscles are merged into the joint above them: toes are in
// shoes, and the face moves by morph targets.
import { at, add, scale, unit, sub, cross, length } from '../shape/normals.js';

const FOLDED = /^(toe|breast|special|oris|levator|oculi|risorius|temporalis)/;

/**
 * @typedef {object} Joint
 * @property {string} name as in the source, with `-` and `.` replaced by `_`: `finger2_1_L`
 * @property {number} parent number of a joint before this one, −1 for the root
 * @property {number[]} head position of the joint, metres, model space
 * @property {number[]} tail the end of its bone
 */

/** `wrist.L` → `wrist_L` */
export const jointName = (bone) => bone.replace(/[-.]/g, '_');

/** @returns {{ joints: Joint[], jointOfBone: Map<string, number> }} parents before children */
export function buildSkeleton(rig, points) {
  const mean = (key) => {
    const vertices = rig.joints[key];
    if (!vertices) throw new Error(`${key}: no vertices for this joint`);
    return scale(
      vertices.reduce((sum, vertex) => add(sum, at(points, vertex)), [0, 0, 0]),
      1 / vertices.length,
    );
  };
  const children = new Map();
  for (const [name, bone] of Object.entries(rig.bones)) {
    const parent = bone.parent ?? '';
    children.set(parent, [...(children.get(parent) ?? []), name]);
  }
  const joints = [];
  const jointOfBone = new Map();
  const visit = (name, parent) => {
    let own = parent;
    if (!FOLDED.test(name)) {
      own = joints.length;
      const bone = rig.bones[name];
      joints.push({ name: jointName(name), parent, head: mean(bone.head), tail: mean(bone.tail) });
    }
    jointOfBone.set(name, own);
    for (const child of (children.get(name) ?? []).sort()) visit(child, own);
  };
  const roots = Object.keys(rig.bones).filter((name) => !rig.bones[name].parent);
  if (roots.length !== 1) throw new Error(`${roots.length} bones without a parent`);
  visit(roots[0], -1);
  return { joints, jointOfBone };
}

/** Returns the weights of the base mesh by joint: per vertex a list of [joint, weight]. */
export function baseWeights(base, jointOfBone) {
  const count = base.weights.length / 4;
  const out = new Array(count);
  for (let v = 0; v < count; ++v) {
    const sum = new Map();
    for (let k = v * 4; k < v * 4 + 4; ++k) {
      if (base.weights[k] <= 0) continue;
      const joint = jointOfBone.get(base.boneNames[base.weightBones[k]]);
      if (joint === undefined) throw new Error(`vertex ${v}: weight of an unknown bone`);
      sum.set(joint, (sum.get(joint) ?? 0) + base.weights[k]);
    }
    out[v] = [...sum];
  }
  return out;
}

/** Applies a stencil to weights and keeps the four largest, normalised to a sum of one. */
export function carryWeights(stencil, weights) {
  const joints = new Uint8Array(stencil.rows * 4);
  const shares = new Float64Array(stencil.rows * 4);
  for (let row = 0; row < stencil.rows; ++row) {
    const sum = new Map();
    for (let i = stencil.start[row]; i < stencil.start[row + 1]; ++i) {
      for (const [joint, share] of weights[stencil.columns[i]]) {
        sum.set(joint, (sum.get(joint) ?? 0) + share * stencil.values[i]);
      }
    }
    const best = [...sum]
      .filter(([, share]) => share > 0.004)
      .sort((a, b) => b[1] - a[1] || a[0] - b[0])
      .slice(0, 4);
    const total = best.reduce((t, [, share]) => t + share, 0);
    best.forEach(([joint, share], k) => {
      joints[row * 4 + k] = joint;
      shares[row * 4 + k] = share / total;
    });
  }
  return { joints, shares };
}

/** Returns the two axes of a bone at rest: along it, and perpendicular to it in the plane of head, tail and `third`. */
export function planeNormal(head, tail, third) {
  const normal = cross(sub(tail, head), sub(third, head));
  if (length(normal) < 1e-12) throw new Error('a rotation plane whose points lie on a line');
  return unit(normal);
}
