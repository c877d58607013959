// Determines whether a point of the skin lies outside a garment.

const CELL = 0.012; // metres; cloth farther away than this covers nothing

/** @param {{ points: number[][], primitive: import('@gltf-transform/core').Primitive }} part */
export function clothOf({ points, primitive }) {
  const normals = primitive.getAttribute('NORMAL');
  const border = borderOf(points, primitive.getIndices().getArray());
  const cells = new Map();
  const key = (p, dx = 0, dy = 0, dz = 0) => `${Math.floor(p[0] / CELL) + dx},${Math.floor(p[1] / CELL) + dy},${Math.floor(p[2] / CELL) + dz}`;
  points.forEach((point, i) => cells.set(key(point), [...(cells.get(key(point)) ?? []), i]));
  return {
    /** Returns how far outside the nearest cloth the point is, metres; −1 if no cloth is near or the point is beyond its edge. */
    outside(point) {
      let best = CELL ** 2;
      let nearest = -1;
      for (const dx of [-1, 0, 1])
        for (const dy of [-1, 0, 1])
          for (const dz of [-1, 0, 1]) {
            for (const i of cells.get(key(point, dx, dy, dz)) ?? []) {
              const d = points[i].reduce((sum, value, k) => sum + (value - point[k]) ** 2, 0);
              if (d < best) [best, nearest] = [d, i];
            }
          }
      if (nearest < 0 || border.has(nearest)) return -1;
      return normals.getElement(nearest, []).reduce((sum, value, k) => sum + value * (point[k] - points[nearest][k]), 0);
    },
  };
}

/** Returns the vertices at the collar, the cuffs and the hem: on an edge of only one triangle, except seams of the image. */
function borderOf(points, indices) {
  const welded = new Map();
  const number = points.map((point) => {
    const place = point.map((value) => Math.round(value * 20000)).join();
    return welded.get(place) ?? welded.set(place, welded.size).get(place);
  });
  const edges = new Map();
  for (let i = 0; i < indices.length; i += 3) {
    for (let k = 0; k < 3; ++k) {
      const ends = [number[indices[i + k]], number[indices[i + ((k + 1) % 3)]]].sort((a, b) => a - b).join();
      edges.set(ends, (edges.get(ends) ?? 0) + 1);
    }
  }
  const open = new Set([...edges].filter(([, count]) => count === 1).flatMap(([ends]) => ends.split(',').map(Number)));
  return new Set(number.flatMap((each, i) => (open.has(each) ? [i] : [])));
}
