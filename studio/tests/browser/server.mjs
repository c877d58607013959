import { execFileSync, spawn } from 'node:child_process'
import { once } from 'node:events'
import { appendFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { dirname, join, resolve } from 'node:path'
import { fileURLToPath } from 'node:url'
import { inTime, watchLog } from './evidence.mjs'

const kStudio = resolve(dirname(fileURLToPath(import.meta.url)), '../..')
const kBin = process.env.SIGNWEAVE_BIN ?? resolve(kStudio, '../build/release/bin')

const kCharacters = process.env.SIGNWEAVE_CHARACTERS ?? resolve(kStudio, '../build/characters')

/**
 * Runs `work(address, folder)` with a separate server, which serves the built studio, the characters and a demo corpus of two minutes (or `minutes`), and
 * cleans up afterwards. With `mine` an empty database `mine` is served, too, and all are writable; with `channels` one of recordings with tiers for each hand.
 * Videos that the annotation links are expected in `folder`/films. With a `token` the server requires it. `prepare(corpus)` may change the corpus before it is
 * imported.
 */
export async function withServer(site, work, prepare = () => {}, { minutes = 2, mine = false, channels = false, token = '' } = {}) {
  for (const program of ['signweave', 'synthetic_signer']) {
    if (!existsSync(join(kBin, program))) throw new Error(`${join(kBin, program)} does not exist; scripts/build creates it, SIGNWEAVE_BIN sets another folder`)
  }
  if (!existsSync(kCharacters)) throw new Error(`${kCharacters} does not exist; studio/avatar/build creates it, SIGNWEAVE_CHARACTERS sets another folder`)
  const folder = mkdtempSync(join(tmpdir(), 'signweave-studio-'))
  let server
  let unwatch = () => {}
  try {
    const corpus = join(folder, 'corpus'),
      database = join(folder, 'demo.db'),
      films = join(folder, 'films')
    mkdirSync(films)
    execFileSync(join(kBin, 'synthetic_signer'), [corpus, '--minutes', String(minutes)], { stdio: 'ignore' })
    prepare(corpus)
    execFileSync(join(kBin, 'signweave'), ['create', database], { stdio: 'ignore' })
    execFileSync(join(kBin, 'signweave'), ['import', database, corpus], { stdio: 'ignore' })
    if (mine) execFileSync(join(kBin, 'signweave'), ['create', join(folder, 'mine.db')], { stdio: 'ignore' })
    const words = ['serve', database, '--listen', '127.0.0.1:0', '--files', site, '--characters', kCharacters, '--media', films]
    if (channels) words.splice(2, 0, channelsIn(folder))
    if (mine) words.splice(2, 0, join(folder, 'mine.db'), '--writable')
    if (token) {
      writeFileSync(join(folder, 'token'), token)
      words.push('--token-file', join(folder, 'token'))
    }
    server = spawn(join(kBin, 'signweave'), words, { stdio: ['ignore', 'pipe', 'pipe'] })
    const end = () => server.kill('SIGKILL')
    process.once('exit', end) // also if the tests are interrupted
    const log = join(folder, 'server.log')
    writeFileSync(log, '')
    const forget = watchLog(log)
    unwatch = () => {
      process.off('exit', end)
      forget()
    }
    let said = ''
    const address = await inTime(
      new Promise((resolve, reject) => {
        for (const output of [server.stdout, server.stderr]) {
          output.on('data', (data) => {
            appendFileSync(log, data)
            said += data
            const found = /listening on (http:\S+)/.exec(said)
            if (found) resolve(found[1])
          })
        }
        server.once('exit', (code) => reject(new Error(`the server ended with ${code}: ${said}`)))
      }),
      120,
    )
    return await work(address, folder)
  } finally {
    if (server && server.exitCode === null) {
      const ended = once(server, 'close')
      server.kill('SIGTERM')
      await ended
    }
    unwatch()
    rmSync(folder, { recursive: true, force: true })
  }
}

/** Makes a database of the recordings `mains` and `visage`, and returns its path. */
function channelsIn(folder) {
  const corpus = join(folder, 'channels'),
    database = join(folder, 'channels.db')
  execFileSync(join(kBin, 'synthetic_signer'), [corpus, '--channels'], { stdio: 'ignore' })
  execFileSync(join(kBin, 'signweave'), ['create', database], { stdio: 'ignore' })
  execFileSync(join(kBin, 'signweave'), ['import', database, corpus], { stdio: 'ignore' })
  return database
}

/** The third scenario of scripts/demo, for that database. */
export const kScenario3 = [
  'REGION{left hold ..OUEST} NORD SOLEIL-BRILLER OUEST',
  '{q-polar: DEMAIN PLEUVOIR}',
  'VANNES{mouth "vannes"; gaze @left} BREST{mouth "brest"} RENNES{mouth "rennes"}',
].join(' . ')

/** Prepares a corpus: `villes` loses its face and gets a linked video. */
export function linkVideo(corpus) {
  rmSync(join(corpus, 'villes.face.csv'))
  const eaf = join(corpus, 'villes.eaf')
  const linked = '<MEDIA_DESCRIPTOR MEDIA_URL="file:///films/villes.webm" MIME_TYPE="video/webm" RELATIVE_MEDIA_URL="./villes.webm" TIME_ORIGIN="200"/>'
  writeFileSync(eaf, readFileSync(eaf, 'utf8').replace(/(<HEADER[^>]*>)/, `$1${linked}`))
}
