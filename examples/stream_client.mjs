// Signs glosses on a server (`signweave serve`) and writes the stream that it sends as BVH; docs/stream.md tells the bytes.
//   node stream_client.mjs 'http://127.0.0.1:8080?database=demo&token=T' OUT.bvh GLOSS…
import { writeFileSync } from 'node:fs'
import WebSocket from 'ws' // browsers have their own, and Node from 22

const [server, out, ...glosses] = process.argv.slice(2)
const url = new URL('/api/stream' + new URL(server).search, server.replace(/^http/, 'ws'))
const socket = Object.assign(new WebSocket(url), { binaryType: 'arraybuffer' })
const fail = (text) => (console.error(`stream_client.mjs: ${text}`), process.exit(1))
const frames = [], tokens = []
let header, end // the number of the frame after the last, once it is known

socket.onerror = (event) => fail(event.message)
socket.onclose = ({ code, reason }) => code === 1000 || fail(`closed: ${reason || code}`)
socket.onopen = () => [{ type: 'open', pace: 'fast', idle: 'end', batch: 60 }, { type: 'sign', utterance: glosses.join(' ') }]
  .forEach((message) => socket.send(JSON.stringify(message)))
socket.onmessage = ({ data }) => {
  if (typeof data === 'string') told(JSON.parse(data)); else framesOf(data)
  if (frames.length === end) finish()
}

function told(message) {
  if (message.type === 'error') fail(message.message)
  if (message.type === 'header') (header = message).declarations.forEach(({ value }) => console.error(`stream_client.mjs: ${value}`))
  if (message.type === 'place') tokens.push(`${message.gloss || '(piece)'}#${message.token}`)
  if (message.type === 'end') end = message.frame
}
function framesOf(data) { // little-endian, as the machine: typed arrays look at the bytes where they lie
  for (let i = 0, at = 16; i < new Uint16Array(data, 2, 1)[0]; ++i, at += header.frame_bytes) {
    const places = new Int32Array(data, at, 3 * header.translated.length)
    const turns = new Int16Array(data, at + places.byteLength + 4 * header.tracks.length, 4 * header.joints.length)
    frames.push({ place: (joint) => [...places.slice(3 * joint, 3 * joint + 3)].map((v) => v / 1000), // 10 µm to cm
      turn: (joint) => zxy([...turns.slice(4 * joint, 4 * joint + 4)]) })
  }
}
function zxy(q) { // a rotation as degrees about z, then x, then y
  const [x, y, z, w] = q.map((v) => v / Math.hypot(...q))
  return [Math.atan2(2 * (z * w - x * y), 1 - 2 * (x * x + z * z)), Math.asin(Math.min(1, Math.max(-1, 2 * (y * z + x * w)))),
    Math.atan2(2 * (y * w - x * z), 1 - 2 * (x * x + y * y))].map((v) => (v * 180) / Math.PI)
}
function finish() {
  const text = (numbers) => numbers.map((v) => v.toFixed(6)).join(' '), cm = (offset) => text(offset.map((v) => 100 * v))
  const order = [], moved = (joint) => header.translated.indexOf(joint)
  const tree = (joint) => { // children after their parent; `order` is that of the columns
    order.push(joint)
    const channels = moved(joint) < 0 ? '3' : '6 Xposition Yposition Zposition'
    return `${joint ? 'JOINT' : 'ROOT'} ${header.joints[joint].name}\n{\nOFFSET ${cm(header.joints[joint].offset)}\n` +
      `CHANNELS ${channels} Zrotation Xrotation Yrotation\n` +
      header.joints.map((child, i) => (child.parent === joint ? tree(i) : '')).join('') +
      header.tips.map((tip) => (tip.joint === joint ? `End Site\n{\nOFFSET ${cm(tip.offset)}\n}\n` : '')).join('') + '}\n'
  }
  const row = (frame) => order.map((joint) => text([...(moved(joint) < 0 ? [] : frame.place(moved(joint))), ...frame.turn(joint)])).join(' ')
  writeFileSync(out, `HIERARCHY\n${tree(0)}MOTION\nFrames: ${frames.length}\nFrame Time: ${1 / header.rate}\n${frames.map(row).join('\n')}\n`)
  console.log(tokens.join(' ')), socket.close(1000)
}
