// The fixtures shared by all browser tests: one browser, one page, and one server with a demo corpus, recordings with tiers for each hand, and an empty
// database that tests may change.
import { after, afterEach, test as run } from 'node:test'
import { withBrowser } from './chromium.mjs'
import { beginEvidence, inTime, leaveEvidence } from './evidence.mjs'
import { hold } from './hold.mjs'
import { linkVideo, withServer } from './server.mjs'
import { opened } from './waits.mjs'

export const site = process.env.SITE
if (!site) throw new Error('SITE must be the folder of the built studio')
export const kDeclared = /placeholder shapes, not LSF/
/** The server's address, and its working folder. */
export let address, folder
export let context
/** The page that was visited last. */
export let page
/** The errors thrown by pages. */
export const faults = []

let suite = ''
/** The following tests belong to this suite. */
export function begin(name) {
  suite = name
}

/** Sufficient for software rendering on a busy machine. */
const kSeconds = 240
/** Only the tests of main paths run. */
const kMainOnly = process.env.SIGNWEAVE_MAIN === '1'

/** Tests before which `ready` is called. A failing test leaves evidence. With `main`, it belongs to a main path. */
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
      { mine: true, channels: true },
    ),
  )
  ;[address, folder, context] = await held.given
}
after(() => held?.end())

export const test = testsWith(studio)
export const mainTest = testsWith(studio, { main: true })
/** A test that needs neither, and always runs. */
export const plainTest = testsWith(async () => {}, { main: true })

// Theme and language set by one test do not affect the next.
afterEach(() => page?.evaluate(() => (localStorage.removeItem('signweave.theme'), localStorage.removeItem('signweave.language'))).catch(() => {}))

/**
 * Opens a page. Unless characters are tested, the plain body is used, which software renders fast; null keeps the previous choice. `still`: nothing plays
 * automatically.
 */
export async function visit(hash, { size = { width: 1280, height: 720 }, whole = false, body = 'drawn', still = false } = {}) {
  await page?.close()
  page = await context.newPage()
  // A nested frame, such as a drawing, may have no storage.
  if (body)
    await page.addInitScript((who) => {
      try {
        localStorage.setItem('signweave.body', who)
      } catch {
        // It stores nothing.
      }
    }, body)
  page.on('pageerror', (error) => faults.push(error.message))
  await page.setViewportSize(size)
  if (still) await page.emulateMedia({ reducedMotion: 'reduce' })
  await page.goto(`${address}/${hash}`)
  await opened(page, hash, whole)
}
