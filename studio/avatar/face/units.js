// The 52 face units of ARKit, each composed of the source's shape targets and of turned eyes.
//
// `targets`: weights of shape targets; `unit/…` is the expression unit of that name, mixed by the person's origins.
// `side`: only that half of the face takes part, with a soft seam in the middle, so that left + right is the whole.
// `turn`: joints rotated by degrees about an axis of model space (x to the body's left, y up, z forward).
// `shape`: a function of face/shapes.js, if there is no suitable target.

/**
 * @typedef {{ targets?: Record<string, number>, side?: 'left'|'right', turn?: Array<{ joint: string, axis: number[], degrees: number }>, shape?: string
 * }} Unit
 */

const X = [1, 0, 0];
const Y = [0, 1, 0];

/** Unit pairs that differ by side only: `l` is the source's letter, `half` restricts a target that contains both sides. */
function pairs(side) {
  const l = side === 'Left' ? 'l' : 'r';
  const s = side.toLowerCase();
  const suffix = side === 'Left' ? 'L' : 'R';
  const outward = side === 'Left' ? 1 : -1;
  const eye = (axis, degrees) => [{ joint: `eye_${suffix}`, axis, degrees }];
  const half = (targets) => ({ targets, side: s });
  return {
    [`browDown${side}`]: { targets: { [`unit/eyebrows-${s}-down`]: 0.95, [`unit/eyebrows-${s}-inner-up`]: -0.25 }, shape: `frown${side}` },
    [`browOuterUp${side}`]: { shape: `browOuterUp${side}`, targets: { [`unit/eyebrows-${s}-extern-up`]: 0.2 } },
    [`eyeBlink${side}`]: { targets: { [`unit/eye-${s}-closure`]: 1 } },
    [`eyeLookDown${side}`]: { turn: eye(X, 22), targets: { [`unit/eye-${s}-closure`]: 0.38 } },
    [`eyeLookUp${side}`]: { turn: eye(X, -20), targets: { [`unit/eye-${s}-opened-up`]: 0.55 } },
    [`eyeLookIn${side}`]: { turn: eye(Y, -26 * outward) },
    [`eyeLookOut${side}`]: { turn: eye(Y, 26 * outward) },
    [`eyeSquint${side}`]: { targets: { [`unit/eye-${s}-slit`]: 0.75, [`cheek/${l}-cheek-trans-vert-up`]: 0.25 } },
    [`eyeWide${side}`]: { targets: { [`unit/eye-${s}-opened-up`]: 1.25 } },
    [`cheekSquint${side}`]: { targets: { [`cheek/${l}-cheek-trans-vert-up`]: 0.55, [`cheek/${l}-cheek-inner-inflate`]: 0.35, [`unit/eye-${s}-slit`]: 0.3 } },
    [`mouthSmile${side}`]: half({ 'unit/mouth-corner-puller': 0.85 }),
    [`mouthFrown${side}`]: half({ 'unit/mouth-depression': 0.9 }),
    [`mouthDimple${side}`]: half({ 'unit/mouth-retraction': 0.5, 'mouth/mouth-dimples-in': 0.8 }),
    [`mouthStretch${side}`]: half({ 'unit/neck-platysma': 0.8, 'unit/mouth-retraction': 0.4 }),
    [`mouthPress${side}`]: half({ 'unit/mouth-compression': 0.8 }),
    [`mouthLowerDown${side}`]: half({ 'unit/mouth-depression-retraction': 0.9 }),
    [`mouthUpperUp${side}`]: half({ 'unit/mouth-upward-retraction': 0.7 }),
    [`noseSneer${side}`]: { targets: { [`unit/nose-${s}-elevation`]: 1, [`unit/nose-${s}-dilatation`]: 0.8 } },
  };
}

/** @type {Record<string, Unit>} */
export const UNITS = {
  ...pairs('Left'),
  ...pairs('Right'),
  browInnerUp: { shape: 'browInnerUp', targets: { 'unit/eyebrows-left-inner-up': 0.35, 'unit/eyebrows-right-inner-up': 0.35 } },
  cheekPuff: {
    targets: {
      'cheek/l-cheek-volume-inflate': 1.1,
      'cheek/r-cheek-volume-inflate': 1.1,
      'cheek/l-cheek-inner-inflate': 0.35,
      'cheek/r-cheek-inner-inflate': 0.35,
      'unit/mouth-elevation': 0.25,
    },
  },
  jawOpen: { targets: { 'unit/mouth-open': 0.7 } },
  jawForward: { targets: { 'chin/chin-prognathism-more': 1.2 } },
  jawLeft: { shape: 'jawLeft' },
  jawRight: { shape: 'jawRight' },
  mouthClose: { shape: 'mouthClose' },
  mouthFunnel: { targets: { 'unit/mouth-eversion': 0.7, 'unit/mouth-part-later': 0.55, 'unit/mouth-pursing': 0.45 } },
  mouthPucker: { targets: { 'unit/mouth-pursing': 1 } },
  mouthLeft: { targets: { 'mouth/mouth-trans-out': 1 }, shape: 'lipsOnly' },
  mouthRight: { targets: { 'mouth/mouth-trans-in': 1 }, shape: 'lipsOnly' },
  mouthRollLower: { targets: { 'mouth/mouth-lowerlip-volume-deflate': 0.8, 'mouth/mouth-lowerlip-height-min': 1 } },
  mouthRollUpper: { targets: { 'mouth/mouth-upperlip-volume-deflate': 0.8, 'mouth/mouth-upperlip-height-min': 1 } },
  mouthShrugLower: { targets: { 'unit/mouth-elevation': 0.9 } },
  mouthShrugUpper: { targets: { 'mouth/mouth-upperlip-middle-up': 0.4, 'unit/mouth-upward-retraction': 0.35 } },
  tongueOut: { shape: 'tongueOut' },
};
