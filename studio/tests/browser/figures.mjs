// Measures the studio's speed, figures.mjs SITE: nothing is asserted, as machines differ. Sizes are a test, sizes.test.mjs.
import { withBrowser } from './chromium.mjs'
import { withServer } from './server.mjs'
import { opened } from './waits.mjs'

const [site] = process.argv.slice(2)
const kRecording = '#/demo/recording/meteo'

/** Plays for four seconds: ms of the main thread per frame, and frames a second. */
const played = (page) =>
  page.evaluate(async () => {
    const stage = window.signweaveStage
    stage.transport.seek(5)
    stage.transport.play()
    await new Promise((resolve) => setTimeout(resolve, 1500))
    stage.costs.fill(0)
    const from = stage.pictures,
      start = performance.now()
    await new Promise((resolve) => setTimeout(resolve, 4000))
    const pictures = stage.pictures - from
    const taken = [...stage.costs].filter((ms) => ms > 0).sort((a, b) => a - b)
    stage.transport.pause()
    return { median: taken[taken.length >> 1], p95: taken[Math.floor(taken.length * 0.95)], rate: (1000 * pictures) / (performance.now() - start) }
  })

await withServer(
  site,
  async (address) => {
    const { characters } = await (await fetch(`${address}/api/characters`)).json()
    const first = async (label, hash, body, there) => {
      // A separate browser, whose caches are empty.
      await withBrowser(async (context) => {
        await context.addInitScript((who) => localStorage.setItem('signweave.body', who), body)
        const page = await context.newPage()
        await page.goto('about:blank')
        await page.goto(`${address}/${hash}`)
        await page.waitForFunction(there, null, { polling: 'raf' })
        console.log(`first view, ${label}: ${await page.evaluate(() => Math.round(performance.now()))} ms after the page was requested`)
      })
    }
    await first('list of recordings', '#/demo', 'drawn', () => document.querySelector('tbody tr'))
    await first('a recording, drawn body', kRecording, 'drawn', () => window.signweaveStage?.panes[0]?.seen)
    for (const { name } of characters) {
      await first(`a recording, anybody where ${name} comes`, kRecording, name, () => window.signweaveStage?.panes[0]?.seen)
      await first(`a recording, ${name}`, kRecording, name, () => window.signweaveStage?.panes[0]?.seen && window.signweaveStage.panes[0].body.morphs)
    }
    for (const body of ['drawn', ...characters.map(({ name }) => name)]) {
      await withBrowser(async (context) => {
        await context.addInitScript((who) => localStorage.setItem('signweave.body', who), body)
        const page = await context.newPage()
        await page.goto(`${address}/${kRecording}`)
        await opened(page, kRecording, true)
        for (const [name, keys] of [
          [body, []],
          [`${body}, trails and skeleton`, ['t', 's']],
        ]) {
          for (const key of keys) await page.keyboard.press(key)
          const { median, p95, rate } = await played(page)
          console.log(
            `${name}, 1280×720: main thread ${median.toFixed(1)} ms a picture (median; 95 %: ${p95.toFixed(1)} ms), ${rate.toFixed(1)} pictures a second`,
          )
        }
      })
    }
  },
  undefined,
  { mine: true },
)
