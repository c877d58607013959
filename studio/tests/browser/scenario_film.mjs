// Makes what docs/synthesis.md shows of the third scenario: scenario_film.mjs SITE OUT_FOLDER writes scenario_3.png, its contact sheet, and scenario_3.webm, a
// film of the viewer that plays it, with its timeline. Inspect frames of the film at full size.
import { mkdirSync, writeFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { fileURLToPath } from 'node:url'
import { build } from 'vite'
import { withBrowser } from './chromium.mjs'
import { likeACard } from './page_tools.mjs'
import { kScenario3, withServer } from './server.mjs'
import { drawn, opened } from './waits.mjs'

const [site, out] = process.argv.slice(2)
/** Frames a second. */
const kRate = 15
/** Bits per pixel: most of the picture stands still. */
const kBits = 0.035
const kSize = { width: 960, height: 860 }

/** The encoder, as a script. */
async function encoder() {
  const entry = join(dirname(fileURLToPath(import.meta.url)), 'film/encoder.ts')
  const [{ output }] = await build({
    configFile: false,
    logLevel: 'warn',
    build: { write: false, target: 'es2022', lib: { entry, formats: ['iife'], name: 'filmBundle', fileName: 'film' } },
  })
  return output[0].code
}

/** Draws a moment, in seconds, and returns when the page shows it. */
const show = (page, seconds) =>
  page.evaluate(async (to) => {
    const stage = window.signweaveStage,
      before = stage.pictures
    stage.transport.seek(to)
    stage.touch()
    while (stage.pictures === before) await new Promise(requestAnimationFrame)
    stage.renderer.getContext().finish()
    await new Promise(requestAnimationFrame)
  }, seconds)

async function sheet(context, address) {
  const page = await context.newPage()
  await page.goto(address)
  const svg = await page.evaluate(async (utterance) => {
    const body = JSON.stringify({ utterance, format: 'svg' })
    return (await fetch('api/databases/channels/sign', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body })).text()
  }, kScenario3)
  await page.setContent(`<body style="margin: 0">${svg.slice(svg.indexOf('<svg'))}</body>`)
  await page.locator('svg').screenshot({ path: join(out, 'scenario_3.png') })
  await page.close()
}

async function film(context, address) {
  const [player, maker] = [await context.newPage(), await context.newPage()]
  await maker.goto(address)
  await maker.evaluate(await encoder())
  await player.bringToFront()
  await player.emulateMedia({ reducedMotion: 'reduce' })
  await player.addInitScript(() => localStorage.setItem('signweave.body', 'woman'))
  await player.addInitScript(likeACard)
  const hash = `#/channels/sign/${encodeURIComponent(kScenario3)}`
  await player.goto(`${address}/${hash}`)
  await opened(player, hash, true)
  await player.evaluate(() => window.signweaveStage.transport.pause())
  await drawn(player)
  const top = await player.locator('.declarations').evaluate((bar) => Math.floor(bar.getBoundingClientRect().top / 2) * 2)
  const clip = { x: 0, y: top, width: kSize.width, height: kSize.height - top }
  await maker.evaluate(([width, height, rate, bits]) => window.filmEncoder.begin(width, height, rate, bits), [clip.width, clip.height, kRate, kBits])
  const duration = await player.evaluate(() => window.signweaveStage.transport.duration)
  const count = Math.floor(duration * kRate)
  for (let k = 0; k < count; ++k) {
    await show(player, k / kRate)
    const png = (await player.screenshot({ clip })).toString('base64')
    await maker.evaluate((picture) => window.filmEncoder.add(picture), png)
    if (k % kRate === 0) console.log(`${k} of ${count} frames`)
  }
  const bytes = Buffer.from(await maker.evaluate(() => window.filmEncoder.end()), 'base64')
  writeFileSync(join(out, 'scenario_3.webm'), bytes)
  console.log(`${join(out, 'scenario_3.webm')}: ${count} frames, ${bytes.length} bytes`)
}

mkdirSync(out, { recursive: true })
await withServer(
  site,
  (address) =>
    withBrowser(
      async (context) => {
        await sheet(context, address)
        await film(context, address)
      },
      { viewport: kSize, colorScheme: 'dark', locale: 'en-GB' },
    ),
  undefined,
  { channels: true },
)
