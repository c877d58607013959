// Gathers a person: the base mesh in that person's shape, the skeleton, the parts fitted to it, and their face units.
import { openTargets, readBase, readProxy, readRig } from '../source/package.js';
import { baseWeights, buildSkeleton, carryWeights } from '../rig/skeleton.js';
import { faceMarks, faceMorphs } from '../face/morphs.js';
import { closeShare, fitGarment } from './clothes.js';
import { drape, trimSleeves } from './folds.js';
import { at, length, normalsOf, smoothstep, sub } from './normals.js';
import { apply } from './stencil.js';
import { bodyPart, pieces, pointsOf, portion, proxyPart, refined } from './parts.js';
import { PEOPLE } from './people.js';

const DRAWN_IN = 0.004; // metres

/** @param {string} name a key of PEOPLE */
export function gather(name) {
  const person = PEOPLE[name];
  if (!person) throw new Error(`${name}: no such person; there are ${Object.keys(PEOPLE).join(' and ')}`);
  const base = readBase();
  const targets = openTargets();
  for (const [target, weight] of Object.entries(person.shape)) {
    const moves = targets.read(target);
    for (let i = 0; i < moves.length; ++i) base.points[i] += weight * moves[i];
  }
  standOnFloor(base);
  const { joints, jointOfBone } = buildSkeleton(readRig(), base.points);
  const weights = baseWeights(base, jointOfBone);
  const character = { name, person, base, targets, origins: person.origins, skeleton: { joints }, weights };
  character.marks = faceMarks(character);
  const parts = buildParts(character);
  for (const part of parts) {
    part.points = pointsOf(part, base.points);
    part.skin = carryWeights(part.stencil, part.name === 'top' ? sleeveWeights(weights, joints) : weights);
  }
  const facial = parts.filter((part) => /^(head|brows|lashes|eyes|teeth|tongue)$/.test(part.name));
  const morphs = faceMorphs(character, facial);
  for (const part of parts) part.morphs = morphs.get(part.name) ?? new Map();
  targets.close();
  return { ...character, parts };
}

/** Moves the body so that the lowest point of the feet is at height 0. */
function standOnFloor(base) {
  let low = Infinity;
  for (let i = 0; i < 13380; ++i) low = Math.min(low, base.points[i * 3 + 1]);
  for (let i = 1; i < base.points.length; i += 3) base.points[i] -= low;
}

function buildParts({ person, base, skeleton, weights }) {
  const { assets } = person;
  const suit = readProxy('suit');
  const shoes = readProxy('shoes');
  const covered = Float64Array.from(suit.hides, (hides, vertex) => Number(Boolean(hides || shoes.hides[vertex])));
  const deep = farInside(covered, base.quads.corners, 6);
  const body = bodyPart(base, (corners) => !corners.every((vertex) => deep[vertex]));
  const bodyPoints = pointsOf(body, base.points);
  drawIn(body, bodyPoints, covered);
  const chin = skeleton.joints.find((joint) => joint.name === 'neck01').head[1];
  const piece = pieces(body.corners, body.stencil.rows);
  const headPieces = new Set();
  for (let f = 0; f < piece.length; ++f) if (bodyPoints[body.corners[f * 4] * 3 + 1] > chin + 0.05) headPieces.add(piece[f]);
  const clavicle = skeleton.joints.find((joint) => joint.name === 'clavicle_L').head[1];
  const underTop = ([x, y]) => Math.abs(x) > 0.1 || y < clavicle + 0.01;
  const head = portion(body, 'head', (f) => headPieces.has(piece[f]) && !underTop(at(bodyPoints, body.corners[f * 4])));
  const bare = new Set(); // pieces with fingers or ankles; the remaining skin is in the armpits, under cloth
  const ends = skeleton.joints.filter(({ name }) => /^(finger3_3|foot)/.test(name)).map((joint) => joint.head);
  for (let f = 0; f < piece.length; ++f) {
    const p = at(bodyPoints, body.corners[f * 4]);
    if (ends.some((end) => length(sub(p, end)) < 0.08)) bare.add(piece[f]);
  }
  const hands = portion(body, 'hands', (f) => bare.has(piece[f]) && !headPieces.has(piece[f]));

  const [top, trousers] = garments(suit, base, skeleton, weights);
  const hair = proxyPart('hair', readProxy(assets.hair));
  const mouth = (part) => ({ ...part, inMouth: true });
  return [
    head,
    hands,
    eyeballs(proxyPart('eyes', readProxy('eyes'))),
    mouth(setBack(proxyPart('teeth', readProxy('teeth')), base, skeleton, weights)),
    mouth(refined(moved(proxyPart('tongue', readProxy('tongue')), [0, -0.003, -0.008]))),
    proxyPart('lashes', readProxy('lashes')),
    proxyPart('brows', readProxy(assets.brows)),
    hair,
    { ...hair, name: 'hairEdge' },
    top,
    trousers,
    proxyPart('shoes', shoes),
  ];
}

/** A cuff follows the forearm and does not bend with the wrist. */
function sleeveWeights(weights, joints) {
  const forearm = (joint) => {
    const [, side] = /^(?:wrist|finger|metacarpal).*_([LR])$/.exec(joints[joint].name) ?? [];
    return side ? joints.findIndex(({ name }) => name === `lowerarm02_${side}`) : joint;
  };
  const moved = joints.map((_, joint) => forearm(joint));
  return weights.map((list) => list.map(([joint, share]) => [moved[joint], share]));
}

/** Returns the vertices that are covered and at least `rings` rings of faces away from bare skin: invisible through a collar or cuff. */
function farInside(covered, corners, rings) {
  let inside = covered;
  for (let ring = 0; ring < rings; ++ring) {
    const next = Float64Array.from(inside);
    for (let f = 0; f < corners.length; f += 4) {
      const face = corners.subarray(f, f + 4);
      if (!face.every((vertex) => inside[vertex])) face.forEach((vertex) => (next[vertex] = 0));
    }
    inside = next;
  }
  return inside;
}

/** Moves skin under cloth inwards slightly, so that it never shows through. */
function drawIn(body, points, covered) {
  const normals = normalsOf(points, body.corners);
  const share = apply(body.stencil, covered, 1);
  for (let i = 0; i < points.length; ++i) body.offsets[i] -= normals[i] * DRAWN_IN * smoothstep(0.2, 1, share[Math.floor(i / 3)]);
}

/** The source's teeth are so far forward and wide that they show between closed lips, and at their corners. */
function setBack(part, base, { joints }, weights) {
  const points = pointsOf(part, base.points);
  const lower = (vertex) => weights[vertex].some(([joint, share]) => joints[joint].name === 'jaw' && share > 0.5);
  for (let i = 0; i < part.stencil.rows; ++i) {
    part.offsets[i * 3] -= 0.1 * points[i * 3];
    part.offsets[i * 3 + 2] -= 0.0075;
    if (lower(part.stencil.columns[part.stencil.start[i]])) part.offsets[i * 3 + 1] -= 0.0025;
  }
  return part;
}

/** @param {number[]} way metres */
function moved(part, way) {
  for (let i = 0; i < part.offsets.length; ++i) part.offsets[i] += way[i % 3];
  return part;
}

/** The eyeballs without their corneas: glTF has no clear coat that every viewer draws well, so the ball itself is glossy. */
function eyeballs(part) {
  const piece = pieces(part.corners, part.stencil.rows);
  const clear = new Set(); // the cornea's texture coordinates are in the image's transparent corner
  for (let f = 0; f < piece.length; ++f) {
    const uv = part.uvCorners[f * 4] * 2;
    if (part.uvs[uv] > 0.85 && part.uvs[uv + 1] < 0.15) clear.add(piece[f]);
  }
  return portion(part, part.name, (f) => !clear.has(piece[f]));
}

/** Returns the suit as two parts, fitted and then subdivided. */
function garments(suit, base, { joints }, weights) {
  const part = proxyPart('suit', suit);
  const points = pointsOf(part, base.points);
  const body = base.groupNames.indexOf('body');
  const { corners, groups } = base.quads;
  const skinCorners = corners.filter((_, i) => groups[i >> 2] === body);
  const skin = { points: base.points, normals: normalsOf(base.points, skinCorners), numbers: [...new Set(skinCorners)] };
  const arm = closeShare(weights, joints);
  fitGarment(part, points, skin, (_, s) => arm(s));
  const piece = pieces(part.corners, part.stencil.rows);
  const heights = new Map();
  for (let f = 0; f < piece.length; ++f) {
    const y = points[part.corners[f * 4] * 3 + 1];
    heights.set(piece[f], Math.max(heights.get(piece[f]) ?? -Infinity, y));
  }
  const waist = joints.find((joint) => joint.name === 'spine03').head[1];
  const isTop = (f) => heights.get(piece[f]) > waist + 0.1;
  const top = refined(refined(portion(part, 'top', isTop)));
  trimSleeves(top, pointsOf(top, base.points), joints);
  drape(top, pointsOf(top, base.points), joints);
  return [top, refined(portion(part, 'trousers', (f) => !isTop(f)))];
}
