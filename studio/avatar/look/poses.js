// The list of pictures: poses of the arms and hands, and faces. Positions are in metres from the middle between the shoulders (x to the signer's left, y up, z
// forward) and are mirrored for the other hand.

const straight = [0, 0, 0];
const bent = [88, 104, 66];
const open = { thumb: [0, 5, 0], index: [4, 2, 0], middle: [4, 2, 0], ring: [4, 2, 0], little: [4, 2, 0] };
const fist = { thumb: [-10, 60, 30, -45], index: bent, middle: bent, ring: bent, little: bent };

/** Flexion in degrees of each finger's three joints from the straight finger (for the thumb's first joint: from rest), then spread. */
export const HANDS = {
  fist,
  flat: { ...open, thumb: [10, 10, 5, -20] },
  five: { thumb: [-5, 0, 0, 30], index: [0, 2, 0, 12], middle: [0, 2, 0, 2], ring: [0, 2, 0, -9], little: [0, 2, 0, -20] },
  V: { ...fist, thumb: [5, 55, 40, -60], index: [0, 2, 0, 10], middle: [0, 2, 0, -9] },
  ILY: { ...fist, thumb: [-5, 0, 0, 30], index: [0, 2, 0, 4], little: [0, 2, 0, -8] },
  point: { ...fist, thumb: [-10, 60, 20, -60], index: straight },
  thumbToIndex: { ...open, thumb: [35, 0, 12, -20], index: [40, 52, 30] },
  thumbToMiddle: { ...open, thumb: [45, 0, 0, -35], middle: [50, 56, 34] },
  thumbToRing: { ...open, thumb: [5, 50, 0, -65], ring: [56, 60, 36] },
  thumbToLittle: { ...open, thumb: [35, 40, 60, -65], little: [78, 76, 46] },
};

const raised = { at: [0.2, -0.02, 0.3], fingers: [0, 1, 0.1], palm: [0, 0, 1] };
const hand = (shape, pose = raised) => ({ right: { ...pose, shape }, view: 'hand' });

export const PICTURES = {
  rest: {},
  side: { view: 'side' },
  threeQuarter: { view: 'threeQuarter' },
  body: { view: 'body' },
  face: { view: 'face' },
  faceSide: { view: 'faceSide' },
  fist: hand('fist'),
  fistSide: hand('fist', { ...raised, palm: [1, 0, 0] }),
  fistBack: hand('fist', { ...raised, palm: [0, 0, -1] }),
  flat: hand('flat'),
  flatBack: hand('flat', { ...raised, palm: [0, 0, -1] }),
  five: hand('five'),
  V: hand('V'),
  ILY: hand('ILY'),
  point: hand('point'),
  thumbToIndex: hand('thumbToIndex', { ...raised, palm: [0.7, 0, 0.7] }),
  thumbToMiddle: hand('thumbToMiddle', { ...raised, palm: [0.7, 0, 0.7] }),
  thumbToRing: hand('thumbToRing', { ...raised, palm: [0.7, 0, 0.7] }),
  thumbToLittle: hand('thumbToLittle', { ...raised, palm: [0.7, 0, 0.7] }),
  twoHands: {
    right: { at: [0.2, -0.08, 0.3], fingers: [0.1, 1, 0.2], palm: [0, -0.2, 1], shape: 'five' },
    left: { at: [0.2, -0.08, 0.3], fingers: [0.1, 1, 0.2], palm: [0, 0.2, -1], shape: 'five' },
  },
  armsCrossed: {
    right: { at: [-0.04, -0.15, 0.22], fingers: [-1, 0.5, 0.1], palm: [0.1, -0.1, -1], shape: 'fist' },
    left: { at: [-0.04, -0.18, 0.27], fingers: [-1, 0.5, 0.1], palm: [0.1, -0.1, -1], shape: 'fist' },
  },
  handsAtFace: {
    right: { at: [0.1, 0.06, 0.24], fingers: [-0.25, 1, -0.1], palm: [-0.5, 0.1, -0.6], shape: 'flat' },
    left: { at: [0.16, 0.12, 0.2], fingers: [-0.2, 1, 0], palm: [-1, 0, 0.2], shape: 'point' },
  },
  browsUp: { face: { browInnerUp: 1, browOuterUpLeft: 1, browOuterUpRight: 1, eyeWideLeft: 0.6, eyeWideRight: 0.6 }, view: 'face' },
  frown: { face: { browDownLeft: 1, browDownRight: 1, eyeSquintLeft: 0.4, eyeSquintRight: 0.4 }, view: 'face' },
  blink: { face: { eyeBlinkLeft: 1, eyeBlinkRight: 1 }, view: 'face' },
  halfBlink: { face: { eyeBlinkLeft: 0.5, eyeBlinkRight: 0.5 }, view: 'face' },
  winkLeft: { face: { eyeBlinkLeft: 1 }, view: 'face' },
  smile: { face: { mouthSmileLeft: 1, mouthSmileRight: 1, cheekSquintLeft: 0.5, cheekSquintRight: 0.5 }, view: 'face' },
  pout: { face: { mouthPucker: 1 }, view: 'face' },
  openMouth: { face: { jawOpen: 0.7 }, view: 'face' },
  cheeksPuffed: { face: { cheekPuff: 1, mouthPressLeft: 0.3, mouthPressRight: 0.3 }, view: 'face' },
  tongueOut: { face: { tongueOut: 1, jawOpen: 0.3 }, view: 'face' },
  squint: { face: { eyeSquintLeft: 1, eyeSquintRight: 1 }, view: 'face' },
  lookLeft: { face: { eyeLookOutLeft: 1, eyeLookInRight: 1 }, view: 'face' },
  lookDown: { face: { eyeLookDownLeft: 1, eyeLookDownRight: 1 }, view: 'face' },
  lookUp: { face: { eyeLookUpLeft: 1, eyeLookUpRight: 1 }, view: 'face' },
  mouthFrown: { face: { mouthFrownLeft: 1, mouthFrownRight: 1 }, view: 'face' },
  funnel: { face: { mouthFunnel: 1, jawOpen: 0.2 }, view: 'face' },
  teeth: { face: { mouthUpperUpLeft: 1, mouthUpperUpRight: 1, mouthLowerDownLeft: 1, mouthLowerDownRight: 1 }, view: 'face' },
  sneer: { face: { noseSneerLeft: 1, noseSneerRight: 1 }, view: 'face' },
};
