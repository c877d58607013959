// A stencil matrix: every output point is a weighted sum of input points. Fitting to the base mesh and subdividing both have this form, so the product of their
// stencils applies to shapes, morph targets and skin weights alike.

/** @typedef {{ rows: number, start: Int32Array, columns: Int32Array, values: Float64Array }} Stencil */

/** @param {Array<Array<[number, number]>>} lists per row, pairs of column and value @returns {Stencil} */
export function stencilOf(lists) {
  const start = new Int32Array(lists.length + 1);
  lists.forEach((list, row) => (start[row + 1] = start[row] + list.length));
  const columns = new Int32Array(start[lists.length]);
  const values = new Float64Array(columns.length);
  let at = 0;
  for (const list of lists)
    for (const [column, value] of list) {
      columns[at] = column;
      values[at++] = value;
    }
  return { rows: lists.length, start, columns, values };
}

/** @param {Stencil} stencil @param {Float64Array} input `width` numbers a point @returns {Float64Array} */
export function apply(stencil, input, width = 3) {
  const out = new Float64Array(stencil.rows * width);
  for (let row = 0; row < stencil.rows; ++row) {
    for (let i = stencil.start[row]; i < stencil.start[row + 1]; ++i) {
      const from = stencil.columns[i] * width;
      for (let k = 0; k < width; ++k) out[row * width + k] += stencil.values[i] * input[from + k];
    }
  }
  return out;
}

/** @returns {Stencil} first `inner`, then `outer` */
export function product(outer, inner) {
  const lists = [];
  for (let row = 0; row < outer.rows; ++row) {
    const sum = new Map();
    for (let i = outer.start[row]; i < outer.start[row + 1]; ++i) {
      const middle = outer.columns[i];
      for (let j = inner.start[middle]; j < inner.start[middle + 1]; ++j) {
        const column = inner.columns[j];
        sum.set(column, (sum.get(column) ?? 0) + outer.values[i] * inner.values[j]);
      }
    }
    lists.push([...sum]);
  }
  return stencilOf(lists);
}

/** @returns {Stencil} picks points by number */
export function pick(numbers) {
  return stencilOf(Array.from(numbers, (number) => [[number, 1]]));
}
