// Writes a gathered person as GLB: one skin, one mesh per part, face units as morph targets.
import { Document, NodeIO } from '@gltf-transform/core';
import { EXTMeshoptCompression, EXTTextureWebP, KHRMeshQuantization, KHRTextureTransform } from '@gltf-transform/extensions';
import { MeshoptEncoder } from 'meshoptimizer';
import { drawOrder, normalMoves, restNormals, spread } from './vertices.js';
import { numberStore } from './numbers.js';

/** All positions are stored within one box, so that one skin serves every mesh. */
function boxOf(parts) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const { points } of parts) {
    for (let i = 0; i < points.length; ++i) {
      low[i % 3] = Math.min(low[i % 3], points[i]);
      high[i % 3] = Math.max(high[i % 3], points[i]);
    }
  }
  const centre = low.map((value, k) => (value + high[k]) / 2);
  return { centre, half: Math.max(...low.map((value, k) => (high[k] - value) / 2)) * 1.001 };
}

/**
 * @param {object} character of gather()
 * @param {{ small: boolean, extras: object, materials: (document: Document, small: boolean) => Promise<Record<string, any>> }} options
 * @returns {Promise<Uint8Array>}
 */
export async function writeGlb(character, { small, extras, materials }) {
  await MeshoptEncoder.ready;
  const document = new Document();
  const buffer = document.createBuffer();
  const store = numberStore(document, small, buffer);
  const box = small ? boxOf(character.parts) : { centre: [0, 0, 0], half: 1 };
  Object.assign(document.getRoot().getAsset(), {
    generator: 'signweave build_character',
    copyright: 'Core assets of MakeHuman, CC0 1.0 (see NOTICE)',
    extras: { signweave: extras },
  });

  const scene = document.createScene(character.name);
  document.getRoot().setDefaultScene(scene);
  const { skin, root } = writeSkin(document, store, character.skeleton.joints, box);
  scene.addChild(root);
  const looks = await materials(document, small);
  for (const part of character.parts) {
    const mesh = writePart(document, store, part, box).setName(part.name);
    mesh.listPrimitives()[0].setMaterial(looks[part.name]);
    scene.addChild(document.createNode(part.name).setMesh(mesh).setSkin(skin));
  }
  if (small) {
    document.createExtension(KHRMeshQuantization).setRequired(true);
    document.createExtension(EXTMeshoptCompression).setRequired(true).setEncoderOptions({ method: EXTMeshoptCompression.EncoderMethod.QUANTIZE });
  }
  const io = new NodeIO()
    .registerExtensions([EXTMeshoptCompression, EXTTextureWebP, KHRMeshQuantization, KHRTextureTransform])
    .registerDependencies({ 'meshopt.encoder': MeshoptEncoder });
  return io.writeBinary(document);
}

/** Joints are aligned with model space at rest: every rotation is the identity, a translation is the offset from the parent. */
function writeSkin(document, store, joints, { centre, half }) {
  const nodes = joints.map((joint) => {
    const from = joint.parent < 0 ? [0, 0, 0] : joints[joint.parent].head;
    return document.createNode(joint.name).setTranslation(joint.head.map((value, k) => value - from[k]));
  });
  joints.forEach((joint, j) => joint.parent >= 0 && nodes[joint.parent].addChild(nodes[j]));
  const inverse = joints.flatMap(({ head }) => [half, 0, 0, 0, 0, half, 0, 0, 0, 0, half, 0, ...head.map((value, k) => centre[k] - value), 1]);
  const skin = document.createSkin('signer').setSkeleton(nodes[0]).setInverseBindMatrices(store.float(inverse, 16));
  nodes.forEach((node) => skin.addJoint(node));
  return { skin, root: nodes[0] };
}

function writePart(document, store, part, { centre, half }) {
  const order = drawOrder(part);
  const rest = restNormals(part);
  const byPoint = (values, width) => spread(values, order.pointOf, width);
  const uvs = spread(part.uvs, order.uvOf, 2).map((value, i) => Math.min(1, Math.max(0, i % 2 ? 1 - value : value)));
  const primitive = document
    .createPrimitive()
    .setIndices(store.indices(order.indices, order.count))
    .setAttribute(
      'POSITION',
      store.signed(
        byPoint(part.points, 3).map((value, i) => (value - centre[i % 3]) / half),
        3,
      ),
    )
    .setAttribute('NORMAL', store.normal(byPoint(rest, 3)))
    .setAttribute('TEXCOORD_0', store.uv(uvs))
    .setAttribute('JOINTS_0', store.joints(byPoint(part.skin.joints, 4)))
    .setAttribute('WEIGHTS_0', store.weights(byPoint(part.skin.shares, 4)));
  const mesh = document.createMesh().addPrimitive(primitive);
  for (const [name, moves] of part.morphs) {
    const target = document
      .createPrimitiveTarget(name)
      .setAttribute('POSITION', store.moves(byPoint(moves, 3).map((value) => value / half)))
      .setAttribute('NORMAL', store.turns(byPoint(normalMoves(part, rest, moves), 3)));
    primitive.addTarget(target);
  }
  if (part.morphs.size > 0) mesh.setExtras({ targetNames: [...part.morphs.keys()] }).setWeights(new Array(part.morphs.size).fill(0));
  return mesh;
}
