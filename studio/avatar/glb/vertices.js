// Converts a part (with separate points and texture coordinates) to GPU vertices: one for each pair of the two that occurs, in an order that is fast to draw
// and compresses well.
import { MeshoptEncoder } from 'meshoptimizer';
import { normalsOf } from '../shape/normals.js';

/** Morph normals are stored if they change by more than this (length of the difference of unit vectors). */
const LEAST_TURN = 0.006;

/**
 * @param {import('../shape/parts.js').Part & { skin: object, morphs: Map<string, Float64Array> }} part
 * @returns {{ count: number, indices: Uint32Array, pointOf: Int32Array, uvOf: Int32Array }}
 */
export function drawOrder(part) {
  const { corners, uvCorners } = part;
  const numbers = new Map();
  const pointOf = [];
  const uvOf = [];
  const vertices = new Int32Array(corners.length);
  for (let i = 0; i < corners.length; ++i) {
    const key = corners[i] * (part.uvs.length / 2) + uvCorners[i];
    if (!numbers.has(key)) {
      numbers.set(key, pointOf.length);
      pointOf.push(corners[i]);
      uvOf.push(uvCorners[i]);
    }
    vertices[i] = numbers.get(key);
  }
  const indices = new Uint32Array((corners.length / 4) * 6);
  for (let f = 0, to = 0; f < corners.length; f += 4) {
    for (const k of shorterDiagonal(part.points, corners, f) ? [0, 1, 2, 0, 2, 3] : [0, 1, 3, 1, 2, 3]) indices[to++] = vertices[f + k];
  }
  const [remap, count] = MeshoptEncoder.reorderMesh(indices, true, true);
  const sortedPoints = new Int32Array(count);
  const sortedUvs = new Int32Array(count);
  for (let v = 0; v < pointOf.length; ++v) {
    sortedPoints[remap[v]] = pointOf[v];
    sortedUvs[remap[v]] = uvOf[v];
  }
  return { count, indices, pointOf: sortedPoints, uvOf: sortedUvs };
}

function shorterDiagonal(points, corners, f) {
  const gap = (a, b) => Math.hypot(...[0, 1, 2].map((k) => points[corners[f + a] * 3 + k] - points[corners[f + b] * 3 + k]));
  return gap(0, 2) <= gap(1, 3);
}

/** @returns {Float64Array} `width` numbers a vertex, taken from `values` by point or coordinate number */
export function spread(values, numbers, width) {
  const out = new Float64Array(numbers.length * width);
  for (let v = 0; v < numbers.length; ++v) for (let k = 0; k < width; ++k) out[v * width + k] = values[numbers[v] * width + k];
  return out;
}

/** Returns normals at rest by point; at a part's border they account for the surface that was cut away, if `around` contains it. */
export function restNormals(part) {
  return normalsOf(part.points, part.corners);
}

/** @returns {Float64Array} the change of the normals when `moves` is added to the points */
export function normalMoves(part, rest, moves) {
  const moved = part.points.map((value, i) => value + moves[i]);
  const out = normalsOf(moved, part.corners);
  for (let i = 0; i < out.length; i += 3) {
    for (let k = 0; k < 3; ++k) out[i + k] -= rest[i + k];
    if (Math.hypot(out[i], out[i + 1], out[i + 2]) < LEAST_TURN) out[i] = out[i + 1] = out[i + 2] = 0;
  }
  return out;
}
