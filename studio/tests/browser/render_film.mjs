// Renders Scenario 1 as a video and as images, and reports the speed: render_film.mjs ADDRESS OUT_FOLDER [CHARACTER] [VIEW] [film|pictures] [RATE]. ADDRESS is
// a running `signweave serve DEMO.db --files SITE`. Inspect the images at full size.
import { mkdirSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { withBrowser } from './chromium.mjs'
import { kScenario1, withRenderer } from './render_page.mjs'

const [address, out, character = '', view = 'front', only = '', rate = '30'] = process.argv.slice(2)
mkdirSync(out, { recursive: true })
const label = `${character || 'drawn'}_${view}`
await withRenderer(address, async ({ run }) =>
  withBrowser(async (context) => {
    const page = await context.newPage()
    page.on('console', (message) => console.log(`  page: ${message.text()}`))
    const report = ({ fault, done, seconds }) =>
      console.log(
        fault ? `fault: ${fault}` : `${label}: ${JSON.stringify(done)} in ${seconds.toFixed(1)} s: ${(done.frames / seconds).toFixed(1)} pictures a second`,
      )
    if (only !== 'film') {
      const pictures = await run(page, { ...kScenario1, character, view, kind: 'png', at_ms: [0, 2200, 5000, 9000, 12600, 29400] })
      report(pictures)
      for (const [name, body] of pictures.files) writeFileSync(join(out, `${label}_${name}`), body)
    }
    if (only === 'pictures') return
    const film = await run(page, { ...kScenario1, character, view, rate: Number(rate) }, { timeout: 3_600_000 })
    report(film)
    for (const [name, body] of film.files) {
      writeFileSync(join(out, `${label}_${name}`), body)
      console.log(`${name}: ${body.length} bytes`)
    }
  }),
)
