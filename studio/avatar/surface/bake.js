// Paints values of points into an image laid out by texture coordinates.

/**
 * @param {import('../shape/parts.js').Part[]} parts that share one layout
 * @param {(part: object) => Float64Array} valuesOf `width` numbers a point
 * @returns {Float32Array} `width` numbers a pixel; the surroundings of each island are filled from it
 */
export function bake(parts, valuesOf, width, size) {
  const image = new Float32Array(size * size * width);
  const filled = new Uint8Array(size * size);
  for (const part of parts) {
    const values = valuesOf(part);
    const { corners, uvCorners, uvs } = part;
    for (let f = 0; f < corners.length; f += 4) {
      for (const triangle of [
        [0, 1, 2],
        [0, 2, 3],
      ]) {
        const points = triangle.map((k) => corners[f + k]);
        const at = triangle.map((k) => [uvs[uvCorners[f + k] * 2] * size - 0.5, (1 - uvs[uvCorners[f + k] * 2 + 1]) * size - 0.5]);
        paint(image, filled, size, at, points, values, width);
      }
    }
  }
  for (let pass = 0; pass < 8; ++pass) grow(image, filled, size, width);
  return image;
}

function paint(image, filled, size, [a, b, c], points, values, width) {
  const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (Math.abs(area) < 1e-9) return;
  const low = (k) => Math.max(0, Math.floor(Math.min(a[k], b[k], c[k])));
  const high = (k) => Math.min(size - 1, Math.ceil(Math.max(a[k], b[k], c[k])));
  for (let y = low(1); y <= high(1); ++y) {
    for (let x = low(0); x <= high(0); ++x) {
      const u = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / area;
      const v = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / area;
      const w = 1 - u - v;
      if (u < -0.01 || v < -0.01 || w < -0.01) continue;
      const pixel = y * size + x;
      filled[pixel] = 1;
      for (let k = 0; k < width; ++k) {
        image[pixel * width + k] = u * values[points[0] * width + k] + v * values[points[1] * width + k] + w * values[points[2] * width + k];
      }
    }
  }
}

/** Fills empty pixels next to filled ones, so that no seam shows when the image is scaled down. */
function grow(image, filled, size, width) {
  const before = filled.slice();
  for (let y = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x) {
      const pixel = y * size + x;
      if (before[pixel]) continue;
      const near = [x > 0 && pixel - 1, x < size - 1 && pixel + 1, y > 0 && pixel - size, y < size - 1 && pixel + size];
      const from = near.find((each) => each !== false && before[each]);
      if (from === undefined) continue;
      filled[pixel] = 1;
      for (let k = 0; k < width; ++k) image[pixel * width + k] = image[from * width + k];
    }
  }
}

/** Returns how hollow (negative) or raised the surface is at each point: its distance from the mean of its neighbours, per metre of edge. */
export function hollowness(part, normals, passes) {
  const { points, corners } = part;
  const count = points.length / 3;
  let smooth = points;
  for (let pass = 0; pass < passes; ++pass) smooth = neighbourMean(smooth, corners, count);
  const out = new Float64Array(count);
  const edge = meanEdge(points, corners, count);
  for (let i = 0; i < count; ++i) {
    let rise = 0;
    for (let k = 0; k < 3; ++k) rise += (points[i * 3 + k] - smooth[i * 3 + k]) * normals[i * 3 + k];
    out[i] = rise / (edge[i] * Math.sqrt(passes));
  }
  return neighbourMean(out, corners, count, 1);
}

function neighbourMean(values, corners, count, width = 3) {
  const sum = Float64Array.from(values);
  const share = new Float64Array(count).fill(1);
  for (let f = 0; f < corners.length; f += 4) {
    for (let k = 0; k < 4; ++k) {
      const a = corners[f + k];
      const b = corners[f + ((k + 1) % 4)];
      for (let j = 0; j < width; ++j) {
        sum[a * width + j] += values[b * width + j] / 2;
        sum[b * width + j] += values[a * width + j] / 2;
      }
      share[a] += 0.5;
      share[b] += 0.5;
    }
  }
  return sum.map((value, i) => value / share[Math.floor(i / width)]);
}

function meanEdge(points, corners, count) {
  const sum = new Float64Array(count);
  const number = new Float64Array(count);
  for (let f = 0; f < corners.length; f += 4) {
    for (let k = 0; k < 4; ++k) {
      const a = corners[f + k];
      const b = corners[f + ((k + 1) % 4)];
      const gap = Math.hypot(points[a * 3] - points[b * 3], points[a * 3 + 1] - points[b * 3 + 1], points[a * 3 + 2] - points[b * 3 + 2]);
      for (const each of [a, b]) {
        sum[each] += gap;
        number[each] += 1;
      }
    }
  }
  return sum.map((value, i) => value / Math.max(1, number[i]) + 1e-6);
}
