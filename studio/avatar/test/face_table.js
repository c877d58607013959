// The required effect of each face unit, independent of its implementation. `where` is a region of the face, `way` the direction in which its points must move
// on average: x to the signer's left, y up, z forward. One-sided units must not affect the other side.

const LEFT = 1;
const RIGHT = -1;

/** Regions: `p` is relative to the middle between the eyes, `m` to the middle of the mouth, metres; `side` mirrors them. */
const PLACES = {
  upperLid: (p, side) => Math.abs(side * p[0] - 0.03) < 0.008 && p[1] > 0.001 && p[1] < 0.009,
  lowerLid: (p, side) => Math.abs(side * p[0] - 0.03) < 0.008 && p[1] < -0.004 && p[1] > -0.012,
  innerBrow: (p, side) => side * p[0] > 0.008 && side * p[0] < 0.022,
  outerBrow: (p, side) => side * p[0] > 0.035,
  mouthCorner: (p, side, m) => Math.abs(side * m[0] - 0.025) < 0.006 && Math.abs(m[1]) < 0.007,
  upperLip: (p, side, m) => side * m[0] > -0.002 && Math.abs(m[0]) < 0.012 && m[1] > 0.0015 && m[1] < 0.007,
  lowerLip: (p, side, m) => side * m[0] > -0.002 && Math.abs(m[0]) < 0.012 && m[1] < -0.002 && m[1] > -0.009,
  cheek: (p, side, m) => Math.abs(side * m[0] - 0.045) < 0.012 && Math.abs(m[1] - 0.01) < 0.012,
  cheekBone: (p, side) => Math.abs(side * p[0] - 0.036) < 0.012 && Math.abs(p[1] + 0.028) < 0.012,
  nostril: (p, side) => Math.abs(side * p[0] - 0.014) < 0.006 && Math.abs(p[1] + 0.043) < 0.008,
  chin: (p, side, m) => Math.abs(m[0]) < 0.015 && m[1] < -0.03 && m[1] > -0.045,
  iris: (p, side) => Math.abs(side * p[0] - 0.029) < 0.005 && Math.abs(p[1]) < 0.005,
  tongueTip: () => true,
};

/** `least` is in metres: how far the region must move in that direction at least, on average. */
const row = (part, where, way, least, side = 0) => ({ part, where: PLACES[where], way, least, side });
const UP = [0, 1, 0];
const DOWN = [0, -1, 0];
const FORWARD = [0, 0, 1];

export const FACE = {
  jawOpen: row('head', 'chin', DOWN, 0.008),
  jawForward: row('head', 'chin', FORWARD, 0.002),
  jawLeft: row('head', 'chin', [LEFT, 0, 0], 0.003),
  jawRight: row('head', 'chin', [RIGHT, 0, 0], 0.003),
  mouthClose: row('head', 'lowerLip', UP, 0.004),
  mouthFunnel: row('head', 'lowerLip', FORWARD, 0.001),
  mouthPucker: row('head', 'lowerLip', FORWARD, 0.003),
  mouthLeft: row('head', 'lowerLip', [LEFT, 0, 0], 0.002),
  mouthRight: row('head', 'lowerLip', [RIGHT, 0, 0], 0.002),
  mouthShrugLower: row('head', 'lowerLip', UP, 0.001),
  mouthShrugUpper: row('head', 'upperLip', UP, 0.0008),
  mouthRollLower: row('head', 'lowerLip', [0, 0, -1], 0.0003),
  mouthRollUpper: row('head', 'upperLip', [0, 0, -1], 0.0003),
  browInnerUp: row('brows', 'innerBrow', UP, 0.004),
  cheekPuff: row('head', 'cheek', FORWARD, 0.001),
  tongueOut: row('tongue', 'tongueTip', FORWARD, 0.01),
};
for (const [name, side] of [
  ['Left', LEFT],
  ['Right', RIGHT],
]) {
  const sided = (part, where, way, least) => row(part, where, way, least, side);
  FACE[`browDown${name}`] = sided('brows', 'innerBrow', DOWN, 0.0015);
  FACE[`browOuterUp${name}`] = sided('brows', 'outerBrow', UP, 0.004);
  FACE[`eyeBlink${name}`] = sided('head', 'upperLid', DOWN, 0.0012);
  FACE[`eyeSquint${name}`] = sided('head', 'lowerLid', UP, 0.0004);
  FACE[`eyeWide${name}`] = sided('head', 'upperLid', UP, 0.0006);
  FACE[`eyeLookUp${name}`] = sided('eyes', 'iris', UP, 0.001);
  FACE[`eyeLookDown${name}`] = sided('eyes', 'iris', DOWN, 0.001);
  FACE[`eyeLookOut${name}`] = sided('eyes', 'iris', [side, 0, 0], 0.001);
  FACE[`eyeLookIn${name}`] = sided('eyes', 'iris', [-side, 0, 0], 0.001);
  FACE[`cheekSquint${name}`] = sided('head', 'cheekBone', UP, 0.0005);
  FACE[`mouthSmile${name}`] = sided('head', 'mouthCorner', UP, 0.003);
  FACE[`mouthFrown${name}`] = sided('head', 'mouthCorner', DOWN, 0.002);
  FACE[`mouthDimple${name}`] = sided('head', 'mouthCorner', [0, 0, -1], 0.0005);
  FACE[`mouthStretch${name}`] = sided('head', 'mouthCorner', [side, 0, 0], 0.0005);
  FACE[`mouthPress${name}`] = sided('head', 'lowerLip', UP, 0.0003);
  FACE[`mouthLowerDown${name}`] = sided('head', 'lowerLip', DOWN, 0.0008);
  FACE[`mouthUpperUp${name}`] = sided('head', 'upperLip', UP, 0.0006);
  FACE[`noseSneer${name}`] = sided('head', 'nostril', UP, 0.001);
}
