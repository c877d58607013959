// One step of Catmull-Clark subdivision. It is linear, so it is returned as a stencil; texture coordinates are halved linearly.
import { stencilOf } from './stencil.js';

/**
 * @param {Int32Array} corners four point numbers a face
 * @param {number} count number of points
 * @param {boolean} smooth false: new points in the middle of edges and faces, old ones unchanged
 */
export function subdivide(corners, count, smooth = true) {
  const faces = corners.length / 4;
  const edges = new Map(); // key -> { number, ends, faces }
  const edgeOf = new Int32Array(corners.length);
  for (let f = 0; f < faces; ++f) {
    for (let k = 0; k < 4; ++k) {
      const a = corners[f * 4 + k];
      const b = corners[f * 4 + ((k + 1) % 4)];
      const key = Math.min(a, b) * count + Math.max(a, b);
      let edge = edges.get(key);
      if (!edge) edges.set(key, (edge = { number: edges.size, ends: [a, b], faces: [] }));
      edge.faces.push(f);
      edgeOf[f * 4 + k] = edge.number;
    }
  }
  const edgeList = [...edges.values()];
  const lists = new Array(count + faces + edgeList.length);
  const faceCorners = (f) => corners.subarray(f * 4, f * 4 + 4);

  for (let f = 0; f < faces; ++f) lists[count + f] = Array.from(faceCorners(f), (point) => [point, 0.25]);
  edgeList.forEach((edge, e) => {
    const inside = smooth && edge.faces.length === 2;
    const own = inside ? 0.25 : 0.5;
    const list = edge.ends.map((point) => [point, own]);
    if (inside) for (const f of edge.faces) for (const point of faceCorners(f)) list.push([point, 0.0625]);
    lists[count + faces + e] = merged(list);
  });
  if (smooth) smoothOld(corners, count, edgeList, lists);
  else for (let p = 0; p < count; ++p) lists[p] = [[p, 1]];

  const out = new Int32Array(faces * 16);
  for (let f = 0; f < faces; ++f) {
    for (let k = 0; k < 4; ++k) {
      const at = (f * 4 + k) * 4;
      out[at] = corners[f * 4 + k];
      out[at + 1] = count + faces + edgeOf[f * 4 + k];
      out[at + 2] = count + f;
      out[at + 3] = count + faces + edgeOf[f * 4 + ((k + 3) % 4)];
    }
  }
  return { stencil: stencilOf(lists), corners: out };
}

/** The old points: inside by the usual rule, on a border by the curve through the border; corners and isolated points are unchanged. */
function smoothOld(corners, count, edgeList, lists) {
  const facesAt = Array.from({ length: count }, () => []);
  const edgesAt = Array.from({ length: count }, () => []);
  for (let i = 0; i < corners.length; ++i) facesAt[corners[i]].push(i >> 2);
  for (const edge of edgeList) for (const point of edge.ends) edgesAt[point].push(edge);
  for (let p = 0; p < count; ++p) {
    const border = edgesAt[p].filter((edge) => edge.faces.length !== 2);
    const other = (edge) => (edge.ends[0] === p ? edge.ends[1] : edge.ends[0]);
    const n = facesAt[p].length;
    if (n === 0 || (border.length > 0 && border.length !== 2)) {
      lists[p] = [[p, 1]];
    } else if (border.length === 2) {
      lists[p] = merged([[p, 0.75], ...border.map((edge) => [other(edge), 0.125])]);
    } else {
      const list = [[p, (n - 3) / n]];
      for (const f of facesAt[p]) for (let k = 0; k < 4; ++k) list.push([corners[f * 4 + k], 0.25 / (n * n)]);
      for (const edge of edgesAt[p]) for (const point of edge.ends) list.push([point, 1 / (n * edgesAt[p].length)]);
      lists[p] = merged(list);
    }
  }
}

function merged(list) {
  const sum = new Map();
  for (const [column, value] of list) sum.set(column, (sum.get(column) ?? 0) + value);
  return [...sum];
}
