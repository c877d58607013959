// Shows a built character (studio/avatar/build) on the studio's stage: character.mjs CHARACTER.glb OUT_FOLDER. Tests what the stage must do with it, and takes
// pictures for inspection. The poses are rest poses: retargeting is not tested here.
import assert from 'node:assert/strict'
import { createReadStream, existsSync, mkdirSync, mkdtempSync, rmSync } from 'node:fs'
import { createServer } from 'node:http'
import { tmpdir } from 'node:os'
import { basename, dirname, extname, join, normalize } from 'node:path'
import { fileURLToPath } from 'node:url'
import { build } from 'vite'
import { withBrowser } from './chromium.mjs'

const [glb, out] = process.argv.slice(2)
if (!glb || !out) {
  console.error('character.mjs CHARACTER.glb OUT_FOLDER')
  process.exit(2)
}
const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.glb': 'model/gltf-binary' }
const name = basename(glb, '.glb')
const site = mkdtempSync(join(tmpdir(), 'signweave-character-'))
const root = join(dirname(fileURLToPath(import.meta.url)), 'character')
mkdirSync(out, { recursive: true })

const server = createServer((request, response) => {
  const path = normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname))
  const file = path === '/character.glb' ? glb : join(site, path === '/' ? 'index.html' : path)
  if (!existsSync(file)) return response.writeHead(404).end()
  response.writeHead(200, { 'content-type': kTypes[extname(file)] ?? 'application/octet-stream' })
  createReadStream(file).pipe(response)
})

try {
  await build({ root, configFile: false, logLevel: 'warn', base: './', build: { outDir: site, emptyOutDir: true, target: 'es2022' } })
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready))
  await withBrowser(
    async (context) => {
      const page = await context.newPage()
      page.on('pageerror', (error) => console.error(error.message))
      await page.goto(`http://127.0.0.1:${server.address().port}/`)
      await page.waitForFunction('window.wear')
      const made = await page.evaluate(() => window.wear('/character.glb'))
      console.log(`${name}: read in ${made.ms} ms, ${made.tracks} face weights`)
      const picture = async (label, work) => {
        await page.evaluate(work)
        await page.waitForFunction(
          async () => {
            const from = window.stage.pictures
            window.stage.touch()
            await new Promise((resolve) => setTimeout(resolve, 100))
            return window.stage.pictures > from && window.stage.panes[0].camera.settled
          },
          null,
          { timeout: 120_000 },
        )
        await page.screenshot({ path: join(out, `${name}_${label}.png`) })
        console.log(join(out, `${name}_${label}.png`))
      }
      await picture('front', () => window.stage.look('front'))
      for (const view of ['left', 'hands', 'whole']) await picture(view, `window.stage.look('${view}')`)
      await picture('oblique', () => (window.stage.look('face'), window.stage.orbit(0.7, 0.05)))
      for (const [label, frame] of [
        ['face', 0],
        ['smile', 1],
        ['blink', 2],
        ['brows', 3],
      ]) {
        await picture(label, `(window.stage.look('face'), window.transport.seek(${frame} / 10), window.stage.touch())`)
      }
      const meshes = await page.evaluate(() => window.meshes())
      const opened = meshes.filter(({ moved }) => moved.includes('jawOpen')).map((mesh) => mesh.name)
      assert.ok(opened.length >= 2, `the jaw opens only in ${opened}`)
      const order = (part) => meshes.find((mesh) => mesh.name === part)?.order
      assert.ok(order('hairEdge') > order('hair'), `hairEdge is drawn ${order('hairEdge')}, hair ${order('hair')}`)
      assert.ok(await page.evaluate(() => window.stage.panes[0].body.hasFace && window.stage.panes[0].body.shines))

      const first = await page.evaluate(() => window.clear())
      await page.evaluate(() => window.wear('/character.glb'))
      await page.waitForTimeout(1500)
      const again = await page.evaluate(() => window.clear())
      assert.deepEqual(again, first, 'the graphics card still holds parts of a disposed character')
      console.log(`${name}: still held after disposal: ${JSON.stringify(again)}`)
    },
    { viewport: { width: 900, height: 720 } },
  )
} finally {
  server.close()
  server.closeAllConnections()
  rmSync(site, { recursive: true, force: true })
}
