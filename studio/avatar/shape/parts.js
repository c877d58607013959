// The parts of the character: each is a mesh of quads whose points are a stencil of the base mesh's points plus an offset.
import { apply, pick, product, stencilOf } from './stencil.js';
import { subdivide } from './subdivide.js';

/**
 * @typedef {object} Part
 * @property {string} name
 * @property {import('./stencil.js').Stencil} stencil from base points to this part's points
 * @property {Float64Array} offsets metres, added after the stencil
 * @property {Int32Array} corners four point numbers a face
 * @property {Int32Array} uvCorners
 * @property {Float64Array} uvs
 * @property {boolean} [inMouth] teeth or tongue
 * @property {Float64Array} [points] at rest, metres
 */

/** @param {Part} part @param {Float64Array} base points of the base mesh */
export function pointsOf(part, base) {
  const out = apply(part.stencil, base);
  for (let i = 0; i < out.length; ++i) out[i] += part.offsets[i];
  return out;
}

/** Returns the skin: the base mesh's own faces, subdivided once. `keep` selects faces by their four base points. */
export function bodyPart(base, keep) {
  const body = base.groupNames.indexOf('body');
  const { corners, uvCorners, uvs, groups } = base.quads;
  const chosen = [];
  for (let f = 0; f < groups.length; ++f) if (groups[f] === body) chosen.push(f);
  const whole = faces(corners, chosen);
  const count = base.points.length / 3;
  const fine = subdivide(whole, count);
  const fineUv = subdivide(faces(uvCorners, chosen), uvs.length / 2, false);
  const kept = [];
  chosen.forEach((f, i) => {
    if (keep(corners.subarray(f * 4, f * 4 + 4))) for (let k = 0; k < 4; ++k) kept.push(i * 4 + k);
  });
  return compact({
    name: 'body',
    stencil: fine.stencil,
    offsets: new Float64Array(fine.stencil.rows * 3),
    corners: faces(fine.corners, kept),
    uvCorners: faces(fineUv.corners, kept),
    uvs: apply(fineUv.stencil, Float64Array.from(uvs), 2),
  });
}

/** Returns a proxy with its points at the source's positions. */
export function proxyPart(name, proxy) {
  const rows = proxy.refs.length / 3;
  const lists = [];
  for (let row = 0; row < rows; ++row) {
    lists.push([0, 1, 2].map((k) => [proxy.refs[row * 3 + k], proxy.weights[row * 3 + k]]));
  }
  const { corners, uvCorners, uvs } = proxy.quads;
  return { name, stencil: stencilOf(lists), offsets: proxy.offsets, corners, uvCorners, uvs: Float64Array.from(uvs) };
}

/** @param {Part} part @returns {Part} */
export function refined(part) {
  const fine = subdivide(part.corners, part.stencil.rows);
  const fineUv = subdivide(part.uvCorners, part.uvs.length / 2, false);
  return {
    ...part,
    stencil: product(fine.stencil, part.stencil),
    offsets: apply(fine.stencil, part.offsets),
    corners: fine.corners,
    uvCorners: fineUv.corners,
    uvs: apply(fineUv.stencil, part.uvs, 2),
  };
}

/** Returns the faces of a part that `choose` accepts, by number, with only the points they use. */
export function portion(part, name, choose) {
  const chosen = [];
  for (let f = 0; f < part.corners.length / 4; ++f) if (choose(f)) chosen.push(f);
  return compact({ ...part, name, corners: faces(part.corners, chosen), uvCorners: faces(part.uvCorners, chosen) });
}

/** Returns the number of each face's connected piece, in the order of their first faces. */
export function pieces(corners, pointCount) {
  const parent = Int32Array.from({ length: pointCount }, (_, i) => i);
  const find = (i) => {
    while (parent[i] !== i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (let i = 0; i < corners.length; i += 4) {
    for (let k = 1; k < 4; ++k) parent[find(corners[i + k])] = find(corners[i]);
  }
  const numbers = new Map();
  const out = new Int32Array(corners.length / 4);
  for (let f = 0; f < out.length; ++f) {
    const root = find(corners[f * 4]);
    if (!numbers.has(root)) numbers.set(root, numbers.size);
    out[f] = numbers.get(root);
  }
  return out;
}

function faces(corners, numbers) {
  const out = new Int32Array(numbers.length * 4);
  numbers.forEach((f, i) => out.set(corners.subarray(f * 4, f * 4 + 4), i * 4));
  return out;
}

/** @param {Part} part @returns {Part} without points that no face uses */
function compact(part) {
  const used = [];
  const number = new Map();
  const corners = part.corners.map((point) => {
    if (!number.has(point)) {
      number.set(point, used.length);
      used.push(point);
    }
    return number.get(point);
  });
  const offsets = new Float64Array(used.length * 3);
  used.forEach((point, i) => offsets.set(part.offsets.subarray(point * 3, point * 3 + 3), i * 3));
  return { ...part, corners, offsets, stencil: product(pick(used), part.stencil) };
}
