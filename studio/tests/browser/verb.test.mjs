// `signweave render` as its user calls it.
import assert from 'node:assert/strict'
import { execFile } from 'node:child_process'
import { existsSync, readdirSync, readFileSync } from 'node:fs'
import { join, resolve } from 'node:path'
import { after } from 'node:test'
import { promisify } from 'node:util'
import { hold } from './hold.mjs'
import { readWebm } from './render_webm.mjs'
import { withServer } from './server.mjs'
import { site, testsWith } from './suite.mjs'

const bin = process.env.SIGNWEAVE_BIN ?? resolve(import.meta.dirname, '../../../build/release/bin')
const characters = process.env.SIGNWEAVE_CHARACTERS ?? resolve(import.meta.dirname, '../../../build/characters')
const run = promisify(execFile)

/** Returns the width and height in a PNG's header. */
function sizeOf(path) {
  const bytes = readFileSync(path)
  assert.equal(bytes.toString('latin1', 1, 4), 'PNG')
  return [bytes.readUInt32BE(16), bytes.readUInt32BE(20)]
}

let folder, held
/** Creates a database; its server is not used. */
async function started() {
  held ??= hold((work) => withServer(site, (_, made) => work(made)))
  ;[folder] = await held.given
}
after(() => held?.end())
const test = testsWith(started)

const render = (...words) => run(join(bin, 'signweave'), ['render', join(folder, 'demo.db'), ...words, '--studio', site, '--json'])

test('a video contains every frame', async () => {
  const film = join(folder, 'film.webm')
  const { stdout, stderr } = await render('--recording', 'meteo', '--from', '2000', '--to', '3000', '-o', film, '--size', '320x180', '--rate', '25')
  const said = JSON.parse(stdout)
  const read = readWebm(readFileSync(film))
  assert.equal(read.blocks.length, said.frames)
  assert.equal(said.frames, 25)
  assert.deepEqual([read.width, read.height], [320, 180])
  assert.match(stderr, /placeholder shapes, not LSF/)
})

test('images of moments, with a character', async () => {
  const { stdout } = await render(
    'VANNES MATIN',
    '-o',
    join(folder, 'p.png'),
    '--at',
    '300',
    '--at',
    '900',
    '--size',
    '480x270',
    '--character',
    join(characters, 'woman.glb'),
  )
  assert.deepEqual(JSON.parse(stdout).files, [join(folder, 'p-00001.png'), join(folder, 'p-00002.png')])
  for (const name of ['p-00001.png', 'p-00002.png']) assert.deepEqual(sizeOf(join(folder, name)), [480, 270])
  assert.notDeepEqual(readFileSync(join(folder, 'p-00001.png')), readFileSync(join(folder, 'p-00002.png')))
})

test('a junction is generated as specified', async () => {
  const frames = async (junction) =>
    JSON.parse((await render('VANNES MATIN', '--junction', junction, '-o', join(folder, 'j.webm'), '--size', '160x90', '--rate', '10')).stdout).frames
  const more = (await frames('1=quintic,1200ms')) - (await frames('1=300ms'))
  assert.ok(more >= 8 && more <= 10, `${more} frames more for 900 ms`)
})

test('an unknown gloss gives a one-line message, and no file', async () => {
  await assert.rejects(render('VANES', '-o', join(folder, 'none.webm')), (fault) => {
    assert.equal(fault.code, 1)
    assert.match(fault.stderr, /^signweave: .*no sign 'VANES' in this database; did you mean VANNES/m)
    return true
  })
  assert.ok(!existsSync(join(folder, 'none.webm')))
  assert.deepEqual(
    readdirSync(folder).filter((name) => name.startsWith('none')),
    [],
  )
})
