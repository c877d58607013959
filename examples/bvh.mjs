// Writes the frames of a stream as BVH; docs/stream.md describes the header.

/** The rotation `q` (x y z w, of any length) in degrees about z, then x, then y. */
function zxy(q) {
  const [x, y, z, w] = q.map((v) => v / Math.hypot(...q))
  return [Math.atan2(2 * (z * w - x * y), 1 - 2 * (x * x + z * z)), Math.asin(Math.min(1, Math.max(-1, 2 * (y * z + x * w)))),
    Math.atan2(2 * (y * w - x * z), 1 - 2 * (x * x + y * y))].map((v) => (v * 180) / Math.PI)
}
const text = (numbers) => numbers.map((v) => v.toFixed(6)).join(' ')
const cm = (metres) => text(metres.map((v) => 100 * v))

/** The text of a file. Each frame has `place(i)`, the position of the i-th translated joint in metres, and `turn(joint)`, its quaternion. */
export function bvh(header, frames) {
  const order = [], moved = (joint) => header.translated.indexOf(joint)
  const tree = (joint) => { // children follow their parent; `order` is the order of the columns
    order.push(joint)
    const channels = moved(joint) < 0 ? '3' : '6 Xposition Yposition Zposition'
    return `${joint ? 'JOINT' : 'ROOT'} ${header.joints[joint].name}\n{\nOFFSET ${cm(header.joints[joint].offset)}\n` +
      `CHANNELS ${channels} Zrotation Xrotation Yrotation\n` +
      header.joints.map((child, i) => (child.parent === joint ? tree(i) : '')).join('') +
      header.tips.map((tip) => (tip.joint === joint ? `End Site\n{\nOFFSET ${cm(tip.offset)}\n}\n` : '')).join('') + '}\n'
  }
  const row = (frame) => order
    .map((joint) => (moved(joint) < 0 ? '' : `${cm(frame.place(moved(joint)))} `) + text(zxy(frame.turn(joint)))).join(' ')
  return `HIERARCHY\n${tree(0)}MOTION\nFrames: ${frames.length}\nFrame Time: ${1 / header.rate}\n${frames.map(row).join('\n')}\n`
}
