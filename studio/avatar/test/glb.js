// Reads a built GLB as a program would: meshopt decompressed, numbers converted to floats.
import { NodeIO } from '@gltf-transform/core';
import { EXTMeshoptCompression, EXTTextureWebP, KHRMeshQuantization, KHRTextureTransform } from '@gltf-transform/extensions';
import { MeshoptDecoder } from 'meshoptimizer';

/** @param {Uint8Array} bytes @returns {Promise<import('@gltf-transform/core').Document>} */
export async function readGlb(bytes) {
  await MeshoptDecoder.ready;
  return new NodeIO()
    .registerExtensions([EXTMeshoptCompression, EXTTextureWebP, KHRMeshQuantization, KHRTextureTransform])
    .registerDependencies({ 'meshopt.decoder': MeshoptDecoder })
    .readBinary(bytes);
}

/** Returns a part's points in metres at rest, and the displacement of each face unit. */
export function partOf(document, name) {
  const node = document
    .getRoot()
    .listNodes()
    .find((each) => each.getName() === name && each.getMesh());
  if (!node) throw new Error(`${name}: no such part`);
  const primitive = node.getMesh().listPrimitives()[0];
  const inverse = node.getSkin().getInverseBindMatrices().getElement(0, []);
  const scale = inverse[0];
  const origin = node
    .getSkin()
    .listJoints()[0]
    .getWorldTranslation()
    .map((value, k) => value + inverse[12 + k]);
  const position = primitive.getAttribute('POSITION');
  const count = position.getCount();
  const points = Array.from({ length: count }, (_, i) => position.getElement(i, []).map((value, k) => value * scale + origin[k]));
  const units = new Map();
  primitive.listTargets().forEach((target, t) => {
    const moves = target.getAttribute('POSITION');
    const unit = node.getMesh().getExtras().targetNames[t];
    units.set(
      unit,
      Array.from({ length: count }, (_, i) => moves.getElement(i, []).map((value) => value * scale)),
    );
  });
  return { points, units, primitive };
}

/** Returns a unit's mean displacement of the points that `choose` accepts, metres. */
export function meanMove({ points, units }, unit, choose) {
  const moves = units.get(unit);
  const chosen = points.flatMap((point, i) => (choose(point) ? [moves[i]] : []));
  if (chosen.length === 0) throw new Error(`${unit}: no points chosen`);
  return [0, 1, 2].map((k) => chosen.reduce((sum, move) => sum + move[k], 0) / chosen.length);
}

/** Returns the largest move of any point that `choose` accepts, metres. */
export function largestMove({ points, units }, unit, choose = () => true) {
  const moves = units.get(unit);
  return points.reduce((most, point, i) => (choose(point) ? Math.max(most, Math.hypot(...moves[i])) : most), 0);
}
