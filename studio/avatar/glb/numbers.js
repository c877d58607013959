// Number formats: floats in the plain file, integers in the small one (KHR_mesh_quantization).
import { Accessor } from '@gltf-transform/core';

const VEC = { 1: Accessor.Type.SCALAR, 2: Accessor.Type.VEC2, 3: Accessor.Type.VEC3, 4: Accessor.Type.VEC4, 16: Accessor.Type.MAT4 };

/** Much faster than `Type.from(values, change)`, which takes an iterator step for each number. */
function converted(Type, values, change) {
  const out = new Type(values.length);
  for (let i = 0; i < values.length; ++i) out[i] = change(values[i]);
  return out;
}

const toShort = (x) => Math.round(x * 32767);
const toCoarse = (x) => Math.round(x * 1023) * 32;
const toByte = (x) => Math.round(Math.max(-1, Math.min(1, x)) * 127);
const toUnsigned = (x) => Math.round(x * 65535);

/**
 * Returns the number formats for the whole file.
 * @param {import('@gltf-transform/core').Document} document
 */
export function numberStore(document, small, buffer) {
  const make = (array, width, normalized = false) => document.createAccessor().setArray(array).setType(VEC[width]).setNormalized(normalized).setBuffer(buffer);
  const asFloat = (values, width) => make(Float32Array.from(values), width);
  const sparse = (values) => asFloat(values, 3).setSparse(moved(values) < values.length / 6);
  return {
    float: asFloat,
    indices: (values, count) => make(count <= 65535 ? Uint16Array.from(values) : Uint32Array.from(values), 1),
    /** Unit vectors, and positions in the box −1…1. */
    signed: (values, width) => (small ? make(converted(Int16Array, values, toShort), width, true) : asFloat(values, width)),
    normal: (values) => (small ? make(converted(Int16Array, values, toCoarse), 3, true) : asFloat(values, 3)),
    uv: (values) => (small ? make(converted(Uint16Array, values, toUnsigned), 2, true) : asFloat(values, 2)),
    joints: (values) => make(Uint8Array.from(values), 4),
    weights: (values) => (small ? make(bytesThatSumTo255(values), 4, true) : asFloat(values, 4)),
    /** Morph displacements: mostly zero, so the plain file stores them sparsely; the small one compresses zeros anyway. */
    moves: (values) => {
      if (small) return make(converted(Int16Array, values, toShort), 3, true);
      return sparse(values);
    },
    turns: (values) => (small ? make(converted(Int8Array, values, toByte), 3, true) : sparse(values)),
  };
}

/** Returns the number of vertices that move. */
function moved(values) {
  let count = 0;
  for (let i = 0; i < values.length; i += 3) if (values[i] || values[i + 1] || values[i + 2]) ++count;
  return count;
}

function bytesThatSumTo255(values) {
  const out = new Uint8Array(values.length);
  for (let v = 0; v < values.length; v += 4) {
    let left = 255;
    for (let k = 3; k > 0; --k) left -= out[v + k] = Math.round(values[v + k] * 255);
    out[v] = left; // the largest weight comes first and absorbs the rounding error
  }
  return out;
}
