import { execFileSync, spawn } from 'node:child_process'
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { dirname, join, resolve } from 'node:path'
import { fileURLToPath } from 'node:url'

const kStudio = resolve(dirname(fileURLToPath(import.meta.url)), '../..')
const kBin = process.env.SIGNWEAVE_BIN ?? resolve(kStudio, '../build/release/bin')

/**
 * Runs `work(address, folder)` with a server of its own, which serves the built studio and a demo corpus of two minutes,
 * and leaves nothing of it behind. `prepare(corpus)` may change the corpus before it is imported.
 */
export async function withServer(site, work, prepare = () => {}) {
  for (const program of ['signweave', 'synthetic_signer']) {
    if (!existsSync(join(kBin, program))) throw new Error(`${join(kBin, program)} is not there; scripts/build makes it, SIGNWEAVE_BIN names another folder`)
  }
  const folder = mkdtempSync(join(tmpdir(), 'signweave-studio-'))
  let server
  try {
    const corpus = join(folder, 'corpus'), database = join(folder, 'demo.db')
    execFileSync(join(kBin, 'synthetic_signer'), [corpus, '--minutes', '2'], { stdio: 'ignore' })
    prepare(corpus)
    execFileSync(join(kBin, 'signweave'), ['create', database], { stdio: 'ignore' })
    execFileSync(join(kBin, 'signweave'), ['import', database, corpus], { stdio: 'ignore' })
    server = spawn(join(kBin, 'signweave'), ['serve', database, '--listen', '127.0.0.1:0', '--files', site], { stdio: ['ignore', 'ignore', 'pipe'] })
    const address = await new Promise((resolve, reject) => {
      let said = ''
      server.stderr.on('data', (data) => {
        said += data
        const found = /listening on (http:\S+)/.exec(said)
        if (found) resolve(found[1])
      })
      setTimeout(() => reject(new Error(`the server did not say where it listens: ${said}`)), 15000).unref()
      server.once('exit', (code) => reject(new Error(`the server ended with ${code}`)))
    })
    return await work(address, folder)
  } finally {
    server?.kill('SIGTERM')
    rmSync(folder, { recursive: true, force: true })
  }
}

/** Prepares a corpus: `villes` loses its face and gets a linked video. */
export function linkVideo(corpus) {
  rmSync(join(corpus, 'villes.face.csv'))
  const eaf = join(corpus, 'villes.eaf')
  const linked = '<MEDIA_DESCRIPTOR MEDIA_URL="file:///films/villes.mp4" MIME_TYPE="video/mp4" RELATIVE_MEDIA_URL="./villes.mp4" TIME_ORIGIN="200"/>'
  writeFileSync(eaf, readFileSync(eaf, 'utf8').replace(/(<HEADER[^>]*>)/, `$1${linked}`))
}
