// The appearance of each part.
import sharp from 'sharp';
import { EXTTextureWebP, KHRTextureTransform } from '@gltf-transform/extensions';
import { assetPath } from '../source/package.js';
import { knitRelief, normalMap, skinRelief } from './noise.js';
import { eyeImage, skinImages, teethImage } from './skin.js';

/** @returns the image as a texture: WebP in the small file, JPEG or PNG in the plain one, which every reader supports */
export async function addTexture(document, small, name, image, { alpha = false, quality = 85 } = {}) {
  if (small) document.createExtension(EXTTextureWebP).setRequired(true);
  const bytes = small
    ? await image.webp({ quality, alphaQuality: 90, effort: 4 }).toBuffer()
    : alpha
      ? await image.png({ compressionLevel: 9, palette: false }).toBuffer()
      : await image.jpeg({ quality: quality + 5, chromaSubsampling: '4:4:4' }).toBuffer();
  const type = small ? 'image/webp' : alpha ? 'image/png' : 'image/jpeg';
  return document.createTexture(name).setImage(new Uint8Array(bytes)).setMimeType(type);
}

const open = (name) => sharp(assetPath(name));

/** @returns {(document, small) => Promise<Record<string, import('@gltf-transform/core').Material>>} materials by part */
export function materialsOf(character) {
  const { person } = character;
  return async (document, small) => {
    const texture = (name, image, options) => addTexture(document, small, name, image, options);
    const make = (name, roughness) => document.createMaterial(name).setMetallicFactor(0).setRoughnessFactor(roughness);
    const repeat = (info, times) =>
      info.setExtension('KHR_texture_transform', document.createExtension(KHRTextureTransform).createTransform().setScale([times, times]));
    const relief = (size, heights, strength) => sharp(normalMap(heights, size, strength), { raw: { width: size, height: size, channels: 3 } });
    const { colour, roughness } = await skinImages(character);
    const skin = make('skin', 1)
      .setBaseColorTexture(await texture('skin', colour))
      .setMetallicRoughnessTexture(await texture('skin roughness', roughness))
      .setNormalTexture(await texture('pores', relief(256, skinRelief(256, 24, 7), 3), { quality: 80 }))
      .setNormalScale(0.16);
    repeat(skin.getNormalTextureInfo(), 26);
    const hair = make('hair', 0.5)
      .setBaseColorTexture(await texture('hair', open(person.assets.hairImage), { alpha: true }))
      .setBaseColorFactor([...person.tint.hair, 1])
      .setAlphaMode('MASK')
      .setAlphaCutoff(0.5)
      .setDoubleSided(true);
    const brows = make('brows', 0.8)
      .setBaseColorTexture(await texture('brows', open(person.assets.browsImage), { alpha: true }))
      .setBaseColorFactor([...person.tint.brows, 1])
      .setAlphaMode('BLEND')
      .setDoubleSided(true);
    const lashes = make('lashes', 0.8)
      .setBaseColorTexture(await texture('lashes', open('lashesImage'), { alpha: true }))
      .setAlphaMode('BLEND')
      .setDoubleSided(true);
    const eyes = make('eyes', 0.1).setBaseColorTexture(await texture('eyes', await eyeImage(person.assets.eyes, person.tint.iris)));
    const teeth = make('teeth', 0.25).setBaseColorTexture(await texture('teeth', await teethImage()));
    const tongue = make('tongue', 0.4)
      .setBaseColorFactor([0.62, 0.36, 0.36, 1])
      .setBaseColorTexture(await texture('tongue', open('tongueImage').removeAlpha()));
    const shade = await texture('cloth shade', open('suitShade').removeAlpha());
    const knit = await texture('knit', relief(256, knitRelief(256, 32), 1.6), { quality: 80 });
    const folds = await texture('cloth folds', open('suitNormal').removeAlpha());
    const cloth = (name, normal) =>
      make(name, 0.92)
        .setBaseColorTexture(shade)
        .setNormalTexture(normal)
        .setBaseColorFactor([...person.tint[name], 1])
        .setDoubleSided(true);
    const top = cloth('top', knit).setNormalScale(0.45);
    repeat(top.getNormalTextureInfo(), 26);
    const shoes = make('shoes', 0.6).setBaseColorFactor([0.02, 0.02, 0.02, 1]);
    const hairSoft = hair.clone().setName('hair edge').setAlphaMode('BLEND');
    return { hairEdge: hairSoft, head: skin, hands: skin, hair, brows, lashes, eyes, teeth, tongue, top, trousers: cloth('trousers', folds), shoes };
  };
}
