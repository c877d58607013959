// Fine relief that repeats without a seam: pores of the skin and the weave of cloth, as normal maps. Deterministic.

/** Returns a small generator of numbers in 0…1 from a seed. */
export function numbersFrom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** @returns {Float64Array} heights 0…1: cells with furrows between them and pores in some, like skin */
export function skinRelief(size, cells, seed) {
  const next = numbersFrom(seed);
  const centres = [];
  for (let y = 0; y < cells; ++y) {
    for (let x = 0; x < cells; ++x) centres.push([(x + next()) / cells, (y + next()) / cells, next()]);
  }
  const out = new Float64Array(size * size);
  const wrap = (d) => d - Math.round(d);
  for (let y = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x) {
      const [u, v] = [x / size, y / size];
      const [cx, cy] = [Math.floor(u * cells), Math.floor(v * cells)];
      let [first, second, pore] = [9, 9, 0];
      for (let j = -2; j <= 2; ++j) {
        for (let i = -2; i <= 2; ++i) {
          const centre = centres[((cy + j + cells) % cells) * cells + ((cx + i + cells) % cells)];
          const d = Math.hypot(wrap(u - centre[0]), wrap(v - centre[1])) * cells;
          if (d < first) [second, first, pore] = [first, d, centre[2]];
          else if (d < second) second = d;
        }
      }
      const furrow = Math.exp(-(((second - first) / 0.22) ** 2));
      const hole = pore > 0.6 ? Math.exp(-((first / 0.25) ** 2)) : 0;
      out[y * size + x] = 1 - 0.55 * furrow - 0.8 * hole;
    }
  }
  return out;
}

/** @returns {Float64Array} heights 0…1 of a fine knit, `columns` stitches wide */
export function knitRelief(size, columns) {
  const out = new Float64Array(size * size);
  for (let y = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x) {
      const u = (x / size) * columns;
      const side = Math.abs((u % 1) - 0.5) * 2;
      const v = (y / size) * columns * 1.25 + side * 0.6;
      out[y * size + x] = 0.6 * Math.sin(Math.PI * (u % 1)) ** 0.5 + 0.4 * Math.abs(Math.sin(Math.PI * v));
    }
  }
  return out;
}

/** @returns {Uint8Array} RGB normal map of a relief that repeats; `strength` is its height in pixels */
export function normalMap(relief, size, strength) {
  const out = new Uint8Array(size * size * 3);
  const height = (x, y) => relief[((y + size) % size) * size + ((x + size) % size)];
  for (let y = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x) {
      const dx = ((height(x + 1, y) - height(x - 1, y)) / 2) * strength;
      const dy = ((height(x, y - 1) - height(x, y + 1)) / 2) * strength; // image rows go down, v goes up
      const n = 1 / Math.hypot(dx, dy, 1);
      const to = (y * size + x) * 3;
      out[to] = Math.round(127.5 - dx * n * 127.5);
      out[to + 1] = Math.round(127.5 - dy * n * 127.5);
      out[to + 2] = Math.round(127.5 + n * 127.5);
    }
  }
  return out;
}
