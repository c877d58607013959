// Smooth normals of a mesh of quads, and small vector functions.

/** @param {Float64Array} points @param {Int32Array} corners @returns {Float64Array} unit, weighted by area */
export function normalsOf(points, corners) {
  const out = new Float64Array(points.length);
  for (let f = 0; f < corners.length; f += 4) {
    const [a, b, c, d] = [corners[f] * 3, corners[f + 1] * 3, corners[f + 2] * 3, corners[f + 3] * 3];
    const ux = points[c] - points[a];
    const uy = points[c + 1] - points[a + 1];
    const uz = points[c + 2] - points[a + 2];
    const vx = points[d] - points[b];
    const vy = points[d + 1] - points[b + 1];
    const vz = points[d + 2] - points[b + 2];
    for (let k = 0; k < 4; ++k) {
      const to = corners[f + k] * 3;
      out[to] += uy * vz - uz * vy;
      out[to + 1] += uz * vx - ux * vz;
      out[to + 2] += ux * vy - uy * vx;
    }
  }
  for (let i = 0; i < out.length; i += 3) {
    const length = Math.hypot(out[i], out[i + 1], out[i + 2]);
    if (length > 0) for (let k = 0; k < 3; ++k) out[i + k] /= length;
    else out[i + 1] = 1;
  }
  return out;
}

export const at = (points, i) => [points[i * 3], points[i * 3 + 1], points[i * 3 + 2]];
export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.hypot(a[0], a[1], a[2]);
export const unit = (a) => scale(a, 1 / length(a));
/** Rotates `v` about the unit `axis` by `angle` radians, right-handed. */
export function rotated(v, axis, angle) {
  const c = Math.cos(angle);
  return add(add(scale(v, c), scale(cross(axis, v), Math.sin(angle))), scale(axis, dot(axis, v) * (1 - c)));
}
/** 0 below `low`, 1 above `high`, smooth in between. */
export function smoothstep(low, high, x) {
  const t = Math.min(1, Math.max(0, (x - low) / (high - low)));
  return t * t * (3 - 2 * t);
}
