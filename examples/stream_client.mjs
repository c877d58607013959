// Signs glosses on a server (`signweave serve`) and writes the stream it sends as BVH; docs/stream.md describes the bytes.
//   node stream_client.mjs 'http://127.0.0.1:8080?database=demo&token=T' OUT.bvh GLOSS…
import { writeFileSync } from 'node:fs'
import WebSocket from 'ws' // browsers have their own, and Node from 22
import { bvh } from './bvh.mjs'

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
  if (typeof data === 'string') handle(JSON.parse(data)); else framesOf(data)
  if (frames.length !== end) return
  writeFileSync(out, bvh(header, frames))
  console.log(tokens.join(' '))
  socket.close(1000)
}
function handle(message) {
  if (message.type === 'error') fail(message.message)
  if (message.type === 'header') (header = message).declarations.forEach(({ value }) => console.error(`stream_client.mjs: ${value}`))
  if (message.type === 'place') tokens.push(`${message.gloss || '(piece)'}#${message.token}`)
  if (message.type === 'end') end = message.frame
}
function framesOf(data) { // little-endian, like the machine: typed arrays view the bytes in place
  for (let i = 0, at = 16; i < new Uint16Array(data, 2, 1)[0]; ++i, at += header.frame_bytes) {
    const places = new Int32Array(data, at, 3 * header.translated.length)
    const turns = new Int16Array(data, at + places.byteLength + 4 * header.tracks.length, 4 * header.joints.length)
    frames.push({ place: (moved) => [...places.slice(3 * moved, 3 * moved + 3)].map((v) => v / 100_000), // 10 µm to metres
      turn: (joint) => [...turns.slice(4 * joint, 4 * joint + 4)] })
  }
}
