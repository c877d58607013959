// What every browser test shares: one browser, one server with a demo corpus (and with an empty database beside it that tests may change), one page.
import { after, afterEach, before, test as run } from 'node:test'
import { withBrowser } from './chromium.mjs'
import { linkVideo, withServer } from './server.mjs'
import { opened } from './waits.mjs'

/** A test that must end in four minutes also where everything is drawn by software on a busy machine. */
export const test = (name, work) => run(name, { timeout: 240_000 }, work)
export const kDeclared = /placeholder shapes, not LSF/
/** Where the server is, and the folder that it works in. */
export let address, folder
export let context
/** The page that was visited last. */
export let page
/** What pages threw. */
export const faults = []
let over

before(async () => {
  await new Promise((ready, broken) => {
    withServer(process.env.SITE, (at, made) => withBrowser(async (opened) => {
      address = at
      folder = made
      context = opened
      await new Promise((end) => {
        over = end
        ready()
      })
    }, { locale: 'en-GB', colorScheme: 'dark', acceptDownloads: true }), linkVideo, { mine: true }).catch(broken)
  })
})
after(() => over?.())
// Colours and language that a test chose are not those of the next.
afterEach(() => page?.evaluate(() => (localStorage.removeItem('signweave.theme'), localStorage.removeItem('signweave.language'))).catch(() => {}))

/** Opens a page. What is not about characters is asked of the drawn body, which software draws quickly; null is what was chosen before. `still`: nothing plays by itself. */
export async function visit(hash, { size = { width: 1280, height: 720 }, whole = false, body = 'drawn', still = false } = {}) {
  await page?.close()
  page = await context.newPage()
  // A frame of its own, such as a drawing, may have no storage.
  if (body) await page.addInitScript((who) => { try { localStorage.setItem('signweave.body', who) } catch {} }, body)
  page.on('pageerror', (error) => faults.push(error.message))
  await page.setViewportSize(size)
  if (still) await page.emulateMedia({ reducedMotion: 'reduce' })
  await page.goto(`${address}/${hash}`)
  await opened(page, hash, whole)
}
