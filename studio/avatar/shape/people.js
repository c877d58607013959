// The two signers: their shape targets and their clothes.

/**
 * @typedef {object} Person
 * @property {Record<string, number>} origins shares of the source's three origins
 * @property {Record<string, number>} shape weights of shape targets
 * @property {Record<string, string>} assets keys of ASSETS by part
 * @property {Record<string, number[]>} tint linear-light factors of colours, by part
 */

/** The body's targets are products of sex, age, muscle and weight; with one value of each per person, the products are written out. */
function body(sex, origins, muscle, weight) {
  const shape = {};
  for (const [origin, share] of Object.entries(origins)) shape[`macrodetails/${origin}-${sex}-young`] = share;
  for (const [m, mShare] of Object.entries(muscle))
    for (const [w, wShare] of Object.entries(weight)) {
      const kind = `${sex}-young-${m}muscle-${w}weight`;
      shape[`macrodetails/universal-${kind}`] = mShare * wShare;
      shape[`macrodetails/proportions/${kind}-idealproportions`] = 0.7 * mShare * wShare;
    }
  return shape;
}

/** Shares of the source's three origins in shape and in face units. */
const ORIGINS = { caucasian: 0.7, asian: 0.15, african: 0.15 };

/** The source's brows slope towards the nose, which looks stern; here they are level. */
function atEase(share) {
  return {
    'expression/units/caucasian/eyebrows-left-inner-up': share,
    'expression/units/caucasian/eyebrows-right-inner-up': share,
  };
}

/** The source's lips have a gap through which the teeth show. */
const LIPS_TOGETHER = { 'mouth/mouth-lowerlip-middle-up': 0.4, 'mouth/mouth-lowerlip-ext-up': 0.25 };

/** @type {Record<string, Person>} */
export const PEOPLE = {
  woman: {
    origins: ORIGINS,
    shape: {
      ...body('female', ORIGINS, { average: 0.8, max: 0.2 }, { average: 0.9, min: 0.1 }),
      ...atEase(0.4),
      ...LIPS_TOGETHER,
      'mouth/mouth-angles-up': 0.4,
    },
    assets: {
      skin: 'womanSkin',
      eyes: 'eyesLight',
      hair: 'womanHair',
      hairImage: 'womanHairImage',
      brows: 'womanBrows',
      browsImage: 'womanBrowsImage',
    },
    tint: {
      skin: [0.86, 0.71, 0.64],
      iris: [1.0, 0.66, 0.4],
      hair: [0.75, 0.66, 0.6],
      brows: [0.9, 0.75, 0.62],
      top: [0.022, 0.03, 0.048],
      trousers: [0.018, 0.019, 0.022],
    },
  },
  man: {
    origins: ORIGINS,
    shape: {
      ...body('male', ORIGINS, { average: 1 }, { average: 1 }),
      ...atEase(0.5),
      'eyebrows/eyebrows-trans-vert-more': 0.25,
      ...LIPS_TOGETHER,
      'mouth/mouth-angles-up': 0.4,
      'nose/nose-scale-horiz-decr': 0.4,
    },
    assets: {
      skin: 'manSkin',
      eyes: 'eyesBrown',
      hair: 'manHair',
      hairImage: 'manHairImage',
      brows: 'manBrows',
      browsImage: 'manBrowsImage',
    },
    tint: {
      skin: [0.8, 0.68, 0.62],
      iris: [1.25, 0.75, 0.45],
      hair: [0.8, 0.75, 0.7],
      brows: [0.8, 0.68, 0.58],
      top: [0.024, 0.03, 0.04],
      trousers: [0.018, 0.019, 0.022],
    },
  },
};
