// What the studio costs: figures.mjs SITE. Fails where more script is sent than was agreed; times are only told, as machines differ.
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { gzipSync } from 'node:zlib'
import { withBrowser } from './chromium.mjs'
import { withServer } from './server.mjs'
import { opened } from './waits.mjs'

const kScriptBytes = 400_000
const [site] = process.argv.slice(2)
const assets = readdirSync(join(site, 'assets')).filter((name) => name.endsWith('.js'))
const bytes = assets.reduce((sum, name) => sum + gzipSync(readFileSync(join(site, 'assets', name)), { level: 9 }).length, 0)
console.log(`script, compressed: ${bytes} bytes`)

await withServer(site, (address) => withBrowser(async (context) => {
  let page = await context.newPage()
  await page.goto(`${address}/`)
  await page.waitForSelector('tbody tr')
  console.log(`list of recordings: ${await page.evaluate(() => Math.round(performance.now()))} ms after the page was asked for`)
  await page.close()
  page = await context.newPage()
  await page.goto(`${address}/#/demo/recording/meteo`)
  await page.waitForFunction(() => window.signweaveStage?.pictures > 0 && window.signweaveStage.panes.length > 0, null, { polling: 'raf' })
  console.log(`first picture of a recording: ${await page.evaluate(() => Math.round(performance.now()))} ms`)
  await opened(page, '#/demo/recording/meteo', true)
  for (const [name, keys] of [['one signer', []], ['with trails and skeleton', ['t', 's']]]) {
    for (const key of keys) await page.keyboard.press(key)
    const cost = await page.evaluate(async () => {
      const stage = window.signweaveStage
      stage.transport.seek(5)
      stage.transport.play()
      await new Promise((resolve) => setTimeout(resolve, 1500))
      stage.costs.fill(0)
      const from = stage.pictures, start = performance.now()
      await new Promise((resolve) => setTimeout(resolve, 4000))
      const pictures = stage.pictures - from
      const taken = [...stage.costs].filter((ms) => ms > 0).sort((a, b) => a - b)
      stage.transport.pause()
      return { median: taken[taken.length >> 1], p95: taken[Math.floor(taken.length * 0.95)], rate: (1000 * pictures) / (performance.now() - start) }
    })
    console.log(`${name}, 1280×720: main thread ${cost.median.toFixed(1)} ms a picture (median), ${cost.p95.toFixed(1)} ms (95 %), ${cost.rate.toFixed(1)} pictures a second drawn by software`)
  }
}))
if (bytes > kScriptBytes) {
  console.error(`more than ${kScriptBytes} bytes of script`)
  process.exitCode = 1
}
