// The page that `signweave render` opens, in a real browser against a real server.
import assert from 'node:assert/strict'
import { cpSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { after } from 'node:test'
import { withBrowser } from './chromium.mjs'
import { hold } from './hold.mjs'
import { kRequest, withRenderer } from './render_page.mjs'
import { decoded, looked, readWebm } from './render_webm.mjs'
import { withServer } from './server.mjs'
import { site, testsWith } from './suite.mjs'

let api, context, page, renderer
const kPiece = { ...kRequest, call: 'recording', parameters: { recording: 'meteo', from: 2000, to: 3500 }, width: 480, height: 270 }

/** `silent` is `meteo` without declarations, and `faceless` is `meteo` without its face. */
function prepare(corpus) {
  for (const name of ['silent', 'faceless']) {
    for (const end of ['bvh', 'eaf', 'face.csv']) cpSync(join(corpus, `meteo.${end}`), join(corpus, `${name}.${end}`))
  }
  const eaf = join(corpus, 'silent.eaf')
  writeFileSync(eaf, readFileSync(eaf, 'utf8').replace(/\s*<PROPERTY NAME="signweave:placeholder">[^<]*<\/PROPERTY>/, ''))
  rmSync(join(corpus, 'faceless.face.csv'))
}

/** Returns a page with empty caches. */
async function newPage() {
  const fresh = await context.newPage()
  await (await context.newCDPSession(fresh)).send('Network.setCacheDisabled', { cacheDisabled: true })
  return fresh
}

let held
/** Starts a server, a stand-in for `signweave render`, and a browser. */
async function started() {
  held ??= hold((work) => withServer(site, (address) => withRenderer(address, (mine) => withBrowser((browser) => work(address, mine, browser))), prepare))
  ;[api, renderer, context] = await held.given
  page ??= await newPage()
}
after(() => held?.end())
const test = testsWith(started)

/** Returns the server's number of frames of the rendered motion, and their rate; independent of the page's code. */
async function serverFrames({ recording, from, to }) {
  const body = Buffer.from(await (await fetch(`${api}/api/databases/demo/recordings/${recording}/motion?format=frames&from=${from}&to=${to}`)).arrayBuffer())
  return JSON.parse(body.subarray(4, 4 + body.readUInt32LE(0)).toString())
}
const names = (put) => [...put.files.keys()]
const difference = (a, b) => a.reduce((sum, value, i) => sum + Math.abs(value - b[i]), 0) / a.length

test('a video contains every frame, each at the time of its number', async () => {
  const put = await renderer.run(page, kPiece)
  assert.equal(put.fault, undefined)
  const { frames, rate } = await serverFrames(kPiece.parameters)
  const count = Math.floor(((frames - 1) * 30) / rate + 1e-6) + 1
  assert.ok(count >= 44, `${count}`)
  assert.deepEqual(names(put), ['film.webm'])
  const film = readWebm(put.files.get('film.webm'))
  assert.equal(film.blocks.length, count)
  assert.deepEqual(
    film.blocks.map(({ ms }) => ms),
    Array.from({ length: count }, (_, k) => Math.round((1000 * k) / 30)),
  )
  assert.deepEqual([film.codec, film.width, film.height, film.scale, Math.trunc(film.frameNs)], ['V_VP9', 480, 270, 1e6, 33333333])
  assert.ok(Math.abs(film.duration - (1000 * count) / 30) <= 1, `${film.duration} ms`)
  assert.deepEqual(
    film.blocks.flatMap(({ key }, k) => (key ? [k] : [])).filter((k) => k % 60 !== 0),
    [],
  )
  assert.deepEqual(put.done, { frames: count, seconds: count / 30, codec: put.done.codec })
  assert.match(put.done.codec, /^vp09\.00\.\d\d\.08$/)
  const pictures = await decoded(page, film, put.done.codec)
  assert.deepEqual(
    pictures.map(({ timestamp }) => timestamp),
    film.blocks.map(({ ms }) => 1000 * ms),
  )
  for (const { grey, width, height } of [pictures[0], pictures.at(-1)]) {
    assert.deepEqual([width, height], [480, 270])
    assert.ok(Math.max(...grey) - Math.min(...grey) > 40, 'a blank picture')
  }
  assert.ok(difference(pictures[0].grey, pictures.at(-1).grey) > 1, 'the first picture equals the last')
  const still = pictures.slice(1).filter(({ grey }, k) => difference(grey, pictures[k].grey) === 0).length
  assert.ok(still < count / 2, `${still} of ${count} pictures equal the previous one`)
})

const kLong = { ...kPiece, parameters: { recording: 'meteo', from: 2000, to: 6300 }, width: 160, height: 90 }

test('a video longer than two seconds has a key frame every two seconds', async () => {
  const film = readWebm((await renderer.run(page, { ...kLong, rate: 15 })).files.get('film.webm'))
  const keys = film.blocks.flatMap(({ key }, k) => (key ? [k] : []))
  for (const k of [0, 30, 60]) assert.ok(keys.includes(k), `key frames: ${keys}`)
})

test('progress is reported at most twice a second', async () => {
  const put = await renderer.run(page, { ...kLong, kind: 'png', rate: 10 })
  assert.equal(put.files.size, 43)
  // As the page sends it: progress reports may be closer together.
  const sent = await page.evaluate(() =>
    performance
      .getEntriesByType('resource')
      .filter(({ name }) => name.endsWith('/progress'))
      .map(({ startTime }) => startTime),
  )
  assert.ok(sent.length > 2 && sent.length === put.progress.length, `${sent.length} sent, ${put.progress.length} come`)
  sent.slice(1).forEach((ms, i) => assert.ok(ms - sent[i] > 490, `${ms - sent[i]} ms apart`))
  put.progress.slice(1).forEach(({ done, of }, i) => assert.ok(of === 43 && done > put.progress[i].done, `${done} of ${of}`))
  assert.deepEqual(put.late, [])
})

test('images come in order, in the requested size, and are the same for the same moment', async () => {
  const few = { ...kPiece, kind: 'png', width: 320, height: 180, parameters: { recording: 'meteo', from: 2000, to: 2500 }, rate: 10 }
  const every = await renderer.run(page, few)
  assert.deepEqual(
    every.names.filter((name) => name.endsWith('.png')),
    ['00001.png', '00002.png', '00003.png', '00004.png', '00005.png'],
  )
  assert.deepEqual([every.done.frames, every.done.codec], [5, 'png'])
  for (const png of every.files.values()) {
    const { width, height, spread } = await looked(page, png)
    assert.deepEqual([width, height], [320, 180])
    assert.ok(spread > 5, `a blank picture: ${spread}`)
  }
  const chosen = await renderer.run(page, { ...few, at_ms: [400, 0] })
  assert.deepEqual(names(chosen), ['00001.png', '00002.png'])
  assert.ok(chosen.files.get('00001.png').equals(every.files.get('00005.png')), 'the moment 400 ms is another picture')
  assert.ok(chosen.files.get('00002.png').equals(every.files.get('00001.png')), 'the moment 0 is another picture')
  assert.ok(!every.files.get('00001.png').equals(every.files.get('00005.png')), 'nothing moves')
  const beyond = await renderer.run(page, { ...few, at_ms: [501] })
  assert.equal(beyond.fault, 'no frame at 501 ms: the motion lasts 500 ms')
})

test('the declarations of a recording are in every frame, and the note that its face is neutral', async () => {
  const one = { ...kPiece, kind: 'png', width: 640, height: 360, at_ms: [0, 700] }
  const text = {}
  for (const recording of ['meteo', 'silent', 'faceless']) {
    const put = await renderer.run(page, { ...one, parameters: { recording, from: 2000, to: 3500 } })
    assert.equal(put.fault, undefined)
    text[recording] = []
    for (const png of put.files.values()) text[recording].push((await looked(page, png)).text)
  }
  for (const k of [0, 1]) {
    assert.equal(text.silent[k], 0, 'text without declarations')
    assert.ok(text.meteo[k] > 200, `${text.meteo[k]} pixels of text`)
    assert.ok(text.faceless[k] > 1.5 * text.meteo[k], `${text.faceless[k]} and ${text.meteo[k]} pixels of text`)
  }
})

test('the side view and the view of the hands differ from the front view', async () => {
  const one = { ...kPiece, kind: 'png', width: 320, height: 180, at_ms: [700] }
  const pictures = []
  for (const view of ['front', 'side', 'hands']) {
    const put = await renderer.run(page, { ...one, view })
    assert.equal(put.fault, undefined)
    pictures.push(put.files.get('00001.png').toString('base64'))
  }
  assert.equal(new Set(pictures).size, 3)
})

test('a fault is sent as one line, and nothing after it', async () => {
  const wrong = { ...kPiece, call: 'sign', parameters: { utterance: 'VANNNES' } }
  const server = await fetch(`${api}/api/databases/demo/sign`, {
    method: 'POST',
    headers: { 'content-type': 'application/json' },
    body: JSON.stringify({ ...wrong.parameters, format: 'frames' }),
  })
  const gloss = await renderer.run(page, wrong)
  assert.equal(gloss.fault, (await server.json()).error.message)
  assert.match(gloss.fault, /VANNNES/)
  for (const [what, line] of [
    [{ call: 'dance' }, /no call/],
    [{ rate: 0 }, /no rate/],
    [{ width: 8 }, /no width/],
    [{ at_ms: [1] }, /at_ms is for png/],
  ]) {
    assert.match((await renderer.run(page, { ...kPiece, ...what })).fault, line)
  }
  const full = await renderer.run(page, { ...kPiece, kind: 'png', width: 160, height: 90 }, { refuse: (name) => name === '00002.png' })
  assert.equal(full.fault, 'the server did not accept 00002.png: the disk is full')
  renderer.lost = /\/assets\/stage/
  const lost = await renderer.run(page, kPiece)
  renderer.lost = undefined
  assert.match(lost.fault, /import.*\/assets\//)
  for (const put of [gloss, full, lost]) {
    assert.deepEqual([put.done, put.late, names(put).filter((name) => name === 'film.webm')], [undefined, [], []])
    assert.ok(!put.fault.includes('\n'))
  }
})

test('a fault anywhere in the page ends the render', async () => {
  const long = { ...kPiece, parameters: { recording: 'meteo', from: 2000, to: 12000 } }
  const thrown = () => {
    throw new Error('an unexpected fault')
  }
  const rejected = () => void Promise.reject(new Error('nor this'))
  for (const [work, line] of [
    [thrown, 'an unexpected fault'],
    [rejected, 'nor this'],
  ]) {
    const other = await newPage()
    // Once the render is in progress.
    await other.addInitScript(`{
      const timer = setInterval(() => {
        if (!performance.getEntriesByType('resource').some(({ name }) => name.endsWith('/progress'))) return
        clearInterval(timer)
        ;(${work})()
      }, 50)
    }`)
    const put = await renderer.run(other, long)
    assert.match(put.fault, new RegExp(line))
    assert.deepEqual([put.done, put.late], [undefined, []])
    await other.close()
  }
})

test('a requested character is drawn, or a plain body if its surfaces are lost', async () => {
  const { characters } = await (await fetch(`${api}/api/characters`)).json()
  const character = characters[0].name
  const one = { ...kPiece, kind: 'png', width: 640, height: 360, at_ms: [700] }
  const drawn = await renderer.run(page, one)
  const worn = await renderer.run(page, { ...one, character })
  renderer.lost = /\/api\/characters\/./
  const bare = await renderer.run(page, { ...one, character })
  renderer.lost = undefined
  const [a, b, c] = [drawn, worn, bare].map(({ fault, files }) => (assert.equal(fault, undefined), files.get('00001.png')))
  assert.ok((await looked(page, b)).spread > 5, 'a blank picture')
  assert.ok(!a.equals(b) && !b.equals(c), 'the same picture')
  const [said, more] = [(await looked(page, b, 60)).text, (await looked(page, c, 60)).text]
  assert.ok(more > 1.5 * said, `${more} and ${said} pixels of text: no text says that a drawn body is shown instead`)
})
