// Builds both characters once and checks the properties of the files on which the studio and the library rely.
import assert from 'node:assert/strict';
import { before, describe, test } from 'node:test';
import validator from 'gltf-validator';
import { buildCharacter } from '../build.js';
import { UNITS } from '../face/units.js';
import { FACE } from './face_table.js';
import { clothOf } from './cloth.js';
import { largestMove, meanMove, partOf, readGlb } from './glb.js';

const MEGABYTE = 1024 * 1024;
const NOISE = 0.0001; // metres; a tenth of a millimetre is no movement

for (const name of ['woman', 'man']) {
  describe(name, () => {
    /** @type {Uint8Array} */ let small;
    /** @type {Uint8Array} */ let plain;
    let document;
    let extras;
    before(async () => {
      [small, plain] = await buildCharacter(name, [{ small: true }, { small: false }]);
      document = await readGlb(small);
      extras = document.getRoot().getAsset().extras.signweave;
    });
    const known = new Map();
    const parts = (part) => known.get(part) ?? known.set(part, partOf(document, part)).get(part);
    const joints = () => document.getRoot().listSkins()[0].listJoints();

    test('a second build produces identical bytes', async () => {
      const again = await buildCharacter(name, [{ small: true }, { small: false }]);
      assert.ok(Buffer.from(small).equals(Buffer.from(again[0])), 'the small file differs');
      assert.ok(Buffer.from(plain).equals(Buffer.from(again[1])), 'the plain file differs');
    });

    test('the validator finds no errors', async () => {
      for (const bytes of [small, plain]) {
        const { issues } = await validator.validateBytes(bytes, { maxIssues: 10 });
        assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.filter((issue) => issue.severity === 0)));
      }
    });

    test('the small file is small, and the plain one requires no extension', () => {
      assert.ok(small.length < 4 * MEGABYTE, `${small.length} bytes`);
      const json = JSON.parse(Buffer.from(plain.buffer, plain.byteOffset + 20, new DataView(plain.buffer, plain.byteOffset).getUint32(12, true)).toString());
      assert.equal(json.extensionsRequired, undefined);
      assert.equal(json.skins[0].joints.length, 92);
    });

    test('joints are named as in the source, with parents before children', () => {
      const names = joints().map((joint) => joint.getName());
      assert.equal(names.length, 92);
      assert.equal(new Set(names).size, names.length);
      for (const side of ['L', 'R']) {
        for (let finger = 1; finger <= 5; ++finger) {
          for (let k = 1; k <= 3; ++k) assert.ok(names.includes(`finger${finger}_${k}_${side}`));
        }
        const others = [
          'clavicle',
          'shoulder01',
          'upperarm01',
          'upperarm02',
          'lowerarm01',
          'lowerarm02',
          'wrist',
          'eye',
          'orbicularis03',
          'orbicularis04',
          'foot',
        ];
        for (const other of others) assert.ok(names.includes(`${other}_${side}`), other);
      }
      for (const middle of ['root', 'spine05', 'spine01', 'neck01', 'head', 'jaw', 'tongue04']) assert.ok(names.includes(middle), middle);
      joints().forEach((joint, j) => {
        assert.deepEqual(joint.getRotation(), [0, 0, 0, 1]);
        const parent = names.indexOf(joint.getParentNode()?.getName());
        assert.ok(parent < j, names[j]);
      });
    });

    test('every vertex has at most four joints whose weights sum to one', async () => {
      for (const each of [document, await readGlb(plain)]) {
        for (const mesh of each.getRoot().listMeshes()) {
          const primitive = mesh.listPrimitives()[0];
          assert.equal(primitive.getAttribute('JOINTS_1'), null);
          const weights = primitive.getAttribute('WEIGHTS_0');
          for (let i = 0; i < weights.getCount(); ++i) {
            const sum = weights.getElement(i, []).reduce((a, b) => a + b);
            assert.ok(Math.abs(sum - 1) < 1e-5, `${mesh.getName()} vertex ${i}: ${sum}`);
          }
        }
      }
    });

    test('the left and right sides of the skeleton are mirrored', () => {
      const place = new Map(joints().map((joint) => [joint.getName(), joint.getWorldTranslation()]));
      for (const [left, [x, y, z]] of place) {
        if (!left.endsWith('_L')) continue;
        const other = place.get(left.replace(/_L$/, '_R'));
        assert.ok(Math.hypot(x + other[0], y - other[1], z - other[2]) < 0.002, left);
      }
    });

    test('every face unit moves the named region in the expected direction', () => {
      assert.deepEqual(Object.keys(FACE).sort(), Object.keys(UNITS).sort());
      assert.equal(Object.keys(FACE).length, 52);
      assert.deepEqual(extras.faceUnits.missing, []);
      const from = (place, point) => point.map((value, k) => value - place[k]);
      for (const [unit, { part, where, way, least, side }] of Object.entries(FACE)) {
        const mesh = parts(part);
        const here = (point) => where(from(extras.eyes, point), side || 1, from(extras.mouth, point)) && point[2] > 0.06;
        const move = meanMove(mesh, unit, here);
        const along = move.reduce((sum, value, k) => sum + value * way[k], 0);
        assert.ok(along >= least, `${unit}: ${(along * 1000).toFixed(2)} mm, at least ${least * 1000} mm`);
      }
    });

    test('a one-sided unit does not affect the other side', () => {
      for (const [unit, { side }] of Object.entries(FACE)) {
        if (!side) continue;
        for (const part of extras.faceUnits.morphs[unit]) {
          const other = largestMove(parts(part), unit, (point) => side * point[0] < -0.0125);
          assert.ok(other < NOISE, `${unit} moves the other side of ${part} by ${other * 1000} mm`);
        }
      }
    });

    test('a blink closes the eye and moves nothing else in the face', () => {
      const head = parts('head');
      const [, eyeHeight] = extras.eyes;
      const far = largestMove(head, 'eyeBlinkLeft', ([x, y]) => Math.abs(y - eyeHeight) > 0.035 || x < 0.005);
      assert.ok(far < NOISE, `${far * 1000} mm`);
      assert.ok(largestMove(head, 'eyeBlinkLeft') > 0.008);
    });

    test('left and right units are mirrored', () => {
      for (const unit of Object.keys(FACE).filter((each) => /Left$/.test(each) && FACE[each].side)) {
        for (const part of extras.faceUnits.morphs[unit]) {
          const mesh = parts(part);
          const [left, right] = [unit, unit.replace(/Left$/, 'Right')].map((each) => largestMove(mesh, each));
          assert.ok(Math.abs(left - right) < 0.12 * Math.max(left, right) + 0.0003, `${unit} on ${part}: ${left} and ${right}`);
        }
      }
    });

    test('no skin shows through the top at rest', () => {
      const cloth = clothOf(parts('top'));
      for (const part of ['head', 'hands']) {
        for (const point of parts(part).points) {
          const outside = cloth.outside(point);
          assert.ok(outside < 0.0005, `${part} at ${point.map((v) => v.toFixed(3))} is ${outside * 1000} mm outside`);
        }
      }
    });

    test('the metadata of the hands matches the joints', () => {
      const place = new Map(joints().map((joint) => [joint.getName(), joint.getWorldTranslation()]));
      for (const [side, suffix, sign] of [
        ['left', 'L', 1],
        ['right', 'R', -1],
      ]) {
        const hand = extras.hands[side];
        assert.ok(hand.palmNormal[0] * sign < -0.5, 'the palms face the body');
        assert.ok(Math.abs(Math.hypot(...hand.palmNormal) - 1) < 1e-4);
        for (const [finger, { joints: chain, flexionAxis, tip, restFlexion, limits }] of Object.entries(hand.fingers)) {
          chain.forEach((joint) => assert.ok(place.has(joint) && joint.endsWith(`_${suffix}`)));
          if (finger === 'thumb') continue;
          const arm = tip.map((value, k) => value - place.get(chain[0])[k]);
          const goes = [1, 2, 0].map((k, i) => flexionAxis[k] * arm[[2, 0, 1][i]] - flexionAxis[[2, 0, 1][i]] * arm[k]);
          const towardsPalm = goes.reduce((sum, value, k) => sum + value * hand.palmNormal[k], 0);
          assert.ok(towardsPalm > 0.02, `${side} ${finger}: bending goes to the palm`);
          restFlexion.forEach((angle, k) => assert.ok(angle >= limits.flexion[k][0] && angle <= limits.flexion[k][1], `${finger} ${k}`));
        }
      }
    });
  });
}
