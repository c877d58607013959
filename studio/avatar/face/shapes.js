// Face units without a shape target. Each takes a part at rest and returns the displacement of its points.
import { smoothstep } from '../shape/normals.js';

/** The properties of a part available to a shape. `sum` is the displacement from the unit's targets so far; `unit(name)` that of another unit. */

/** Multiplies the sum by `share(point, i)`. */
function masked({ points, sum }, share) {
  const out = new Float64Array(sum.length);
  for (let i = 0; i < points.length / 3; ++i) {
    const keep = share(points[i * 3], points[i * 3 + 1], points[i * 3 + 2], i);
    for (let k = 0; k < 3; ++k) out[i * 3 + k] = sum[i * 3 + k] * keep;
  }
  return out;
}

/** The jaw moves to one side: the displacement of a point is proportional to its lowering when the jaw opens. */
function jawSideways(sign) {
  return (context) => {
    const open = context.unit('jawOpen');
    const out = new Float64Array(open.length);
    for (let i = 0; i < open.length; i += 3) {
      const share = smoothstep(0, 0.02, Math.hypot(open[i], open[i + 1], open[i + 2]));
      out[i] = sign * 0.007 * share;
    }
    return out;
  };
}

/** The brows' inner ends also come together in a frown. */
function frown(sign) {
  return (context) => {
    const { points, sum, marks } = context;
    const out = Float64Array.from(sum);
    for (let i = 0; i < points.length; i += 3) {
      const x = points[i] * sign;
      const near = (1 - smoothstep(0.012, 0.034, x)) * smoothstep(0.001, 0.011, x);
      const level = 1 - smoothstep(0.004, 0.02, Math.abs(points[i + 1] - marks.browHeight));
      const front = smoothstep(marks.faceDepth - 0.06, marks.faceDepth - 0.03, points[i + 2]);
      out[i] -= sign * 0.0035 * near * level * front;
      out[i + 2] += 0.0012 * near * level * front;
    }
    return out;
  };
}

/**
 * A part of the forehead with its brow slides up over the skull, which slopes back. `share(x)` is the fraction by distance from the middle, so that inner and
 * outer parts add up to a whole raised brow.
 */
function raised(height, share) {
  return ({ part, points, sum, marks }) => {
    const out = Float64Array.from(sum);
    for (let i = 0; i < points.length; i += 3) {
      const up = points[i + 1] - marks.browHeight;
      // The hairs of the brow move as one; the skin under them stretches from the lid up.
      const level = part.name === 'brows' ? 1 : smoothstep(-0.016, -0.004, up) * (1 - smoothstep(0.014, 0.05, up));
      const front = smoothstep(marks.faceDepth - 0.075, marks.faceDepth - 0.04, points[i + 2]);
      const move = height * level * front * share(points[i]);
      out[i + 1] += move;
      out[i + 2] -= 0.22 * move;
    }
    return out;
  };
}

const inner = (x) => 1 - smoothstep(0.018, 0.038, Math.abs(x));
const side = (x) => 1 - smoothstep(0.055, 0.072, Math.abs(x));

export const SHAPES = {
  browInnerUp: raised(0.0085, inner),
  browOuterUpLeft: raised(0.0085, (x) => (x > 0 ? side(x) * (1 - inner(x)) : 0)),
  browOuterUpRight: raised(0.0085, (x) => (x < 0 ? side(x) * (1 - inner(x)) : 0)),
  frownLeft: frown(1),
  frownRight: frown(-1),
  jawLeft: jawSideways(1),
  jawRight: jawSideways(-1),

  /** Teeth and tongue do not move when only the lips move. */
  lipsOnly: (context) => (context.part.inMouth ? new Float64Array(context.sum.length) : context.sum),

  /** Undoes the effect of an open jaw on the lips, so that jawOpen + mouthClose is a long face with the lips together. */
  mouthClose(context) {
    if (context.part.inMouth) return new Float64Array(context.sum.length);
    const { marks } = context;
    const open = context.unit('jawOpen');
    const lips = masked({ points: context.points, sum: open }, (x, y) => {
      const level = 1 - smoothstep(0.011, 0.03, Math.abs(y - marks.mouthHeight));
      const wide = 1 - smoothstep(0.028, 0.05, Math.abs(x));
      return -level * wide;
    });
    return lips;
  },

  /** The tongue slides out over the lower lip and bends down. */
  tongueOut(context) {
    const out = new Float64Array(context.sum.length);
    if (context.part.name !== 'tongue') return out;
    const { points, marks } = context;
    let low = Infinity;
    let high = -Infinity;
    for (let i = 2; i < points.length; i += 3) {
      low = Math.min(low, points[i]);
      high = Math.max(high, points[i]);
    }
    for (let i = 0; i < points.length; i += 3) {
      const t = smoothstep(low + 0.1 * (high - low), high, points[i + 2]);
      out[i] = -points[i] * (0.1 * t + 0.3 * t ** 6); // it tapers to its tip
      out[i + 1] = (marks.mouthHeight - 0.004 - points[i + 1]) * 0.8 * t * t - 0.013 * t * t * t * t;
      out[i + 2] = 0.043 * t;
    }
    return out;
  },
};
