// Places the character's hands for a picture. Every joint's rest rotation is the identity, so a joint's rotation is that in model space with its parent's
// rotation removed.
import * as THREE from 'three';

const vector = (values) => new THREE.Vector3(...values);
const radians = (degrees) => (degrees * Math.PI) / 180;

/** Returns the rotation that takes one pair of directions to another. */
function turnOf(fromMain, fromSide, toMain, toSide) {
  const frame = (main, side) => {
    const x = main.clone().normalize();
    const z = x.clone().cross(side).normalize();
    return new THREE.Matrix4().makeBasis(x, z.clone().cross(x), z);
  };
  const turn = frame(toMain, toSide).multiply(frame(fromMain, fromSide).transpose());
  return new THREE.Quaternion().setFromRotationMatrix(turn);
}

/** @param {Record<string, THREE.Bone>} bones @param {object} extras asset.extras.signweave @param {'left'|'right'} side */
export function placeHand(bones, extras, side, { at, fingers, palm, shape }, hands) {
  const sign = side === 'left' ? 1 : -1;
  const suffix = side === 'left' ? 'L' : 'R';
  const hand = extras.hands[side];
  const head = (name) => vector(extras.bones[name].head);
  const mirrored = (values) => vector([values[0] * sign, values[1], values[2]]);
  const middle = head('upperarm01_L').add(head('upperarm01_R')).multiplyScalar(0.5);

  const shoulder = head(`upperarm01_${suffix}`);
  const elbow = head(`lowerarm01_${suffix}`);
  const wrist = head(`wrist_${suffix}`);
  const upper = elbow.clone().sub(shoulder);
  const lower = wrist.clone().sub(elbow);
  const goal = middle.clone().add(mirrored(at));
  const reach = goal.clone().sub(shoulder);
  const far = Math.min(reach.length(), (upper.length() + lower.length()) * 0.999);
  const along = reach.clone().normalize();
  const pole = mirrored([0.55, -1, -0.25]);
  const across = pole.sub(along.clone().multiplyScalar(pole.dot(along))).normalize();
  const share = (upper.lengthSq() - lower.lengthSq() + far * far) / (2 * far);
  const rise = Math.sqrt(Math.max(0, upper.lengthSq() - share * share));
  const newElbow = shoulder.clone().add(along.clone().multiplyScalar(share)).add(across.multiplyScalar(rise));
  const newUpper = newElbow.clone().sub(shoulder);
  const newLower = shoulder.clone().add(along.multiplyScalar(far)).sub(newElbow);

  const upperTurn = turnOf(upper, lower, newUpper, newLower);
  const lowerTurn = turnOf(lower, upper, newLower, newUpper);
  const handTurn = turnOf(vector(hand.direction), vector(hand.palmNormal), mirrored(fingers), mirrored(palm));
  // The forearm takes its share of the hand's twist about the forearm.
  const relative = lowerTurn.clone().invert().multiply(handTurn);
  const axis = lower.clone().normalize();
  const twist = 2 * Math.atan2(axis.dot(new THREE.Vector3(relative.x, relative.y, relative.z)), relative.w);
  const folded = Math.atan2(Math.sin(twist), Math.cos(twist));
  const twisted = (part) => lowerTurn.clone().multiply(new THREE.Quaternion().setFromAxisAngle(axis, folded * part));

  const local = (parentTurn, turn) => parentTurn.clone().invert().multiply(turn);
  const none = new THREE.Quaternion();
  bones[`upperarm01_${suffix}`].quaternion.copy(upperTurn);
  bones[`lowerarm01_${suffix}`].quaternion.copy(local(upperTurn, twisted(0.2)));
  bones[`lowerarm02_${suffix}`].quaternion.copy(local(twisted(0.2), twisted(0.75)));
  bones[`wrist_${suffix}`].quaternion.copy(local(twisted(0.75), handTurn));
  bones[`upperarm02_${suffix}`].quaternion.copy(none);
  bendFingers(bones, hand, hands[shape]);
}

/** @param {Record<string, number[]>} shape flexion of three joints and spread, degrees, by finger */
function bendFingers(bones, hand, shape) {
  for (const [name, finger] of Object.entries(hand.fingers)) {
    const [a, b, c, spread = 0] = shape[name];
    const flexion = new THREE.Vector3(...finger.flexionAxis);
    [a, b, c].forEach((angle, k) => {
      const turn = new THREE.Quaternion().setFromAxisAngle(flexion, radians(angle - finger.restFlexion[k]));
      if (k === 0) turn.multiply(new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(...finger.spreadAxis), radians(spread)));
      bones[finger.joints[k]].quaternion.copy(turn);
    });
  }
}
