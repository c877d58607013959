// What every browser test shares: one browser, one server with a demo corpus (and with an empty database beside it that tests may change), one page.
import { after, afterEach, test as run } from 'node:test'
import { withBrowser } from './chromium.mjs'
import { beginEvidence, inTime, leaveEvidence } from './evidence.mjs'
import { hold } from './hold.mjs'
import { linkVideo, withServer } from './server.mjs'
import { opened } from './waits.mjs'

export const site = process.env.SITE
if (!site) throw new Error('SITE names the folder of the built studio')
export const kDeclared = /placeholder shapes, not LSF/
/** Where the server is, and the folder that it works in. */
export let address, folder
export let context
/** The page that was visited last. */
export let page
/** What pages threw. */
export const faults = []

let suite = ''
/** The tests that follow are those of a suite. */
export function begin(name) {
  suite = name
}

/** Also where everything is drawn by software on a busy machine. */
const kSeconds = 240
/** Only the tests of main paths are run. */
const kMainOnly = process.env.SIGNWEAVE_MAIN === '1'

/** Tests before which `ready` is called. A test that fails leaves evidence. With `main` it is of a main path. */
export const testsWith =
  (ready, { main = false } = {}) =>
  (title, work) => {
    if (kMainOnly && !main) return
    const name = `${suite}: ${title}`
    run(name, async () => {
      beginEvidence(name)
      try {
        await inTime(ready(), kSeconds)
        await inTime(work(), kSeconds)
      } catch (fault) {
        await leaveEvidence(name, fault)
        throw fault
      }
    })
  }

let held
/** The server and the browser that most suites share; the first test that needs them starts them. */
async function studio() {
  held ??= hold((work) =>
    withServer(
      site,
      (at, made) => withBrowser((opened) => work(at, made, opened), { locale: 'en-GB', colorScheme: 'dark', acceptDownloads: true }),
      linkVideo,
      { mine: true },
    ),
  )
  ;[address, folder, context] = await held.given
}
after(() => held?.end())

export const test = testsWith(studio)
export const mainTest = testsWith(studio, { main: true })
/** A test that needs neither, and is always run. */
export const plainTest = testsWith(async () => {}, { main: true })

// Colours and language that a test chose are not those of the next.
afterEach(() => page?.evaluate(() => (localStorage.removeItem('signweave.theme'), localStorage.removeItem('signweave.language'))).catch(() => {}))

/**
 * Opens a page. What is not about characters is asked of the drawn body, which software draws quickly; null is what was chosen before. `still`: nothing
 * plays by itself.
 */
export async function visit(hash, { size = { width: 1280, height: 720 }, whole = false, body = 'drawn', still = false } = {}) {
  await page?.close()
  page = await context.newPage()
  // A frame of its own, such as a drawing, may have no storage.
  if (body)
    await page.addInitScript((who) => {
      try {
        localStorage.setItem('signweave.body', who)
      } catch {
        // It keeps nothing.
      }
    }, body)
  page.on('pageerror', (error) => faults.push(error.message))
  await page.setViewportSize(size)
  if (still) await page.emulateMedia({ reducedMotion: 'reduce' })
  await page.goto(`${address}/${hash}`)
  await opened(page, hash, whole)
}
