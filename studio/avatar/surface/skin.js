// The skin's images: the source's colour with darkened hollows and visible blood, and the roughness.
import sharp from 'sharp';
import { assetPath } from '../source/package.js';
import { normalsOf, smoothstep } from '../shape/normals.js';
import { bake, hollowness } from './bake.js';

const SIZE = 1024;
/** How much light of each colour a hollow, and blood under the skin, absorb. */
const HOLLOW = [0.42, 0.58, 0.62];
const BLOOD = [0.02, 0.3, 0.26];
const bell = (x, width) => Math.exp(-((x / width) ** 2));

/** @returns {Promise<{ colour: sharp.Sharp, roughness: sharp.Sharp }>} */
export async function skinImages(character) {
  const parts = character.parts.filter((part) => part.name === 'head' || part.name === 'hands');
  const values = bake(parts, (part) => pointValues(part, character), 3, SIZE);
  const { data } = await sharp(assetPath(character.person.assets.skin))
    .removeAlpha()
    .resize(SIZE, SIZE, { kernel: 'lanczos3' })
    .raw()
    .toBuffer({ resolveWithObject: true });
  const roughness = Buffer.alloc(SIZE * SIZE * 3);
  const tone = character.person.tint.skin;
  const toLight = Float64Array.from({ length: 256 }, (_, value) => (value / 255) ** 2.2);
  for (let i = 0; i < SIZE * SIZE; ++i) {
    const hollow = values[i * 3];
    const blood = values[i * 3 + 1];
    const gloss = values[i * 3 + 2];
    for (let k = 0; k < 3; ++k) {
      const light = toLight[data[i * 3 + k]] * tone[k] * (1 - hollow * HOLLOW[k]) * (1 - blood * BLOOD[k]);
      data[i * 3 + k] = Math.round(255 * Math.min(1, light) ** (1 / 2.2));
    }
    roughness[i * 3 + 1] = Math.round(255 * Math.min(1, 0.62 - 0.2 * gloss + 0.12 * hollow));
  }
  const raw = { raw: { width: SIZE, height: SIZE, channels: 3 } };
  return { colour: sharp(data, raw), roughness: sharp(roughness, raw).resize(SIZE / 2, SIZE / 2) };
}

/** Returns per point: hollowness 0…1, visible blood 0…1, gloss 0…1. */
function pointValues(part, { skeleton, name }) {
  const { points } = part;
  const normals = normalsOf(points, part.corners);
  const fine = hollowness(part, normals, 2);
  const wide = hollowness(part, normals, 14);
  const joint = (each) => skeleton.joints.find((j) => j.name === each);
  const eye = joint('eye_L').head;
  const tips = skeleton.joints.filter((j) => /^finger\d_3/.test(j.name)).map((j) => j.tail);
  const knuckles = skeleton.joints.filter((j) => /^finger[1-5]_[12]/.test(j.name)).map((j) => j.head);
  const out = new Float64Array(points.length);
  for (let i = 0; i < points.length / 3; ++i) {
    const [x, y, z] = points.subarray(i * 3, i * 3 + 3);
    out[i * 3] = Math.min(1, smoothstep(0.02, 0.3, -fine[i]) * 0.5 + smoothstep(0.02, 0.45, -wide[i]) * 0.75);
    if (part.name === 'head') {
      const up = y - eye[1];
      const front = smoothstep(eye[2] - 0.05, eye[2] - 0.01, z);
      const cheek = bell(Math.abs(x) - 0.042, 0.02) * bell(up + 0.036, 0.02);
      const nose = bell(x, 0.014) * bell(up + 0.04, 0.014);
      const ear = smoothstep(0.066, 0.076, Math.abs(x)) * bell(up + 0.02, 0.04);
      out[i * 3 + 1] = front * (0.5 * cheek + 0.45 * nose) + 0.45 * ear;
      const lips = bell(x, 0.024) * bell(up + 0.078, 0.008);
      const bridge = bell(x, 0.012) * smoothstep(-0.055, -0.03, up) * (1 - smoothstep(0.05, 0.07, up));
      const brow = bell(x, 0.04) * bell(up - 0.045, 0.02);
      out[i * 3 + 2] = front * Math.min(1, 0.9 * lips + 0.55 * bridge + 0.4 * brow);
      if (name === 'woman') out[i * 3 + 1] += front * 0.55 * lips;
    } else {
      const to = (place) => Math.hypot(x - place[0], y - place[1], z - place[2]);
      const tip = Math.max(...tips.map((each) => bell(to(each), 0.014)));
      const knuckle = Math.max(...knuckles.map((each) => bell(to(each), 0.013)));
      out[i * 3 + 1] = Math.min(1, 0.42 * tip + 0.3 * knuckle);
      out[i * 3 + 2] = 0.25 * tip;
    }
  }
  return out;
}

/** Eyes: the white slightly shaded, as by lids; `iris` are factors of the iris's own colour, which is garish in the source. */
export async function eyeImage(name, iris) {
  const { data, info } = await sharp(assetPath(name)).removeAlpha().raw().toBuffer({ resolveWithObject: true });
  for (let i = 0; i < data.length; i += 3) {
    const high = Math.max(data[i], data[i + 1], data[i + 2]);
    const low = Math.min(data[i], data[i + 1], data[i + 2]);
    const coloured = smoothstep(0.12, 0.35, high === 0 ? 1 : (high - low) / high);
    for (let k = 0; k < 3; ++k) {
      const brown = (0.6 * high + 0.4 * low) * iris[k];
      data[i + k] = Math.min(255, Math.round(coloured * brown + (1 - coloured) * data[i + k] * [0.86, 0.83, 0.81][k]));
    }
  }
  return sharp(data, { raw: info });
}

/** Teeth with a natural colour: the source's are grey with black edges. Gums and tongue keep their colour, slightly paler. */
export async function teethImage() {
  const { data, info } = await sharp(assetPath('teethImage')).removeAlpha().raw().toBuffer({ resolveWithObject: true });
  for (let i = 0; i < data.length; i += 3) {
    const high = Math.max(data[i], data[i + 1], data[i + 2]) / 255;
    const low = Math.min(data[i], data[i + 1], data[i + 2]) / 255;
    const tooth = 1 - smoothstep(0.18, 0.45, high === 0 ? 0 : (high - low) / high);
    const ivory = [0.7, 0.66, 0.58].map((value) => value * (0.6 + 0.4 * smoothstep(0.05, 0.75, high)));
    const gum = [0.62, 0.26, 0.26].map((value) => value * (0.55 + 0.6 * high));
    for (let k = 0; k < 3; ++k) data[i + k] = Math.round(255 * Math.min(1, tooth * ivory[k] + (1 - tooth) * gum[k]));
  }
  return sharp(data, { raw: info });
}
