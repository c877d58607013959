// Everything taken from the npm package, in one table. Each of these is also in the core set that upstream's owners released as CC0 (see NOTICE at the root of
// the tree). Add nothing here that is not: no items by users, no scripts.

/** @typedef {{ path: string, use: string }} Asset */

const skin = (folder, image) => `public/data/skins/${folder}/textures/${image}`;
const proxy = (kind, folder, file) => `public/data/proxies/${kind}/${folder}/${file}`;

/** @type {Record<string, Asset>} Paths are relative to the package's folder. */
export const ASSETS = {
  base: { path: 'public/data/models/human_full_size.json', use: 'base mesh hm08 with helpers, texture coordinates, weights' },
  rig: { path: 'src/json/rigs/default.json', use: 'bones, the vertices that place their joints, rotation planes' },
  targetNames: { path: 'src/json/targets/target-list.json', use: 'names of the shape targets' },
  targets: { path: 'public/data/targets/targets.bin', use: 'shape targets: body, head and face units' },

  eyes: { path: proxy('eyes', 'HighPolyEyes', 'HighPolyEyes.json'), use: 'eyeballs with cornea' },
  eyesBrown: { path: proxy('eyes', 'HighPolyEyes', 'textures/brown_eye.png'), use: 'iris of the man' },
  eyesLight: { path: proxy('eyes', 'HighPolyEyes', 'textures/brownlight_eye.png'), use: 'iris of the woman' },
  teeth: { path: proxy('teeth', 'Teeth_Base', 'Teeth_Base.json'), use: 'teeth and gums' },
  teethImage: { path: proxy('teeth', 'Teeth_Base', 'textures/teeth.png'), use: 'colour of teeth and gums' },
  tongue: { path: proxy('tongue', 'tongue01', 'tongue01.json'), use: 'tongue' },
  tongueImage: { path: proxy('tongue', 'tongue01', 'textures/tongue01_diffuse.png'), use: 'colour of the tongue' },
  lashes: { path: proxy('eyelashes', 'Eyelashes01', 'Eyelashes01.json'), use: 'eyelashes' },
  lashesImage: { path: proxy('eyelashes', 'Eyelashes01', 'textures/eyelashes01.png'), use: 'colour and alpha of the lashes' },
  suit: { path: proxy('clothes', 'male_casualsuit02', 'male_casualsuit02.json'), use: 'top with long sleeves, and trousers' },
  suitNormal: { path: proxy('clothes', 'male_casualsuit02', 'textures/male_casualsuit02_normal.png'), use: 'folds' },
  suitShade: { path: proxy('clothes', 'male_casualsuit02', 'textures/male_casualsuit02_ao.png'), use: 'shade in the folds' },
  shoes: { path: proxy('clothes', 'shoes02', 'shoes02.json'), use: 'shoes' },

  womanSkin: { path: skin('young_caucasian_female', 'young_lightskinned_female_diffuse.png'), use: 'skin colour of the woman' },
  womanHair: { path: proxy('hair', 'ponytail01', 'ponytail01.json'), use: 'hair of the woman' },
  womanHairImage: { path: proxy('hair', 'ponytail01', 'textures/ponytail01_diffuse.png'), use: 'colour and alpha of that hair' },
  womanBrows: { path: proxy('eyebrows', 'eyebrow010', 'eyebrow010.json'), use: 'brows of the woman' },
  womanBrowsImage: { path: proxy('eyebrows', 'eyebrow010', 'textures/eyebrow010.png'), use: 'colour and alpha of those brows' },

  manSkin: { path: skin('young_caucasian_male', 'young_lightskinned_male_diffuse.png'), use: 'skin colour of the man' },
  manHair: { path: proxy('hair', 'short04', 'short04.json'), use: 'hair of the man' },
  manHairImage: { path: proxy('hair', 'short04', 'textures/short04_diffuse.png'), use: 'colour and alpha of that hair' },
  manBrows: { path: proxy('eyebrows', 'eyebrow008', 'eyebrow008.json'), use: 'brows of the man' },
  manBrowsImage: { path: proxy('eyebrows', 'eyebrow008', 'textures/eyebrow008.png'), use: 'colour and alpha of those brows' },
};
