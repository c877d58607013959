// The sizes of files sent to the browser, which must not exceed the agreed limits.
import assert from 'node:assert/strict'
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { gzipSync } from 'node:zlib'
import { address, context, site, test } from './suite.mjs'

const kScriptBytes = 400_000
const kCharacterBytes = 4_000_000

test('a character is small enough to be sent', async () => {
  const { characters } = await (await fetch(`${address}/api/characters`)).json()
  assert.ok(characters.length > 0)
  for (const { name } of characters) {
    const { byteLength } = await (await fetch(`${address}/api/characters/${name}`)).arrayBuffer()
    console.log(`${name}: ${byteLength} bytes (at most ${kCharacterBytes})`)
    assert.ok(byteLength <= kCharacterBytes, `${name} has ${byteLength} bytes`)
  }
})

/** Bytes of scripts, compressed, by file name. */
const sizes = new Map(
  readdirSync(join(site, 'assets'))
    .filter((name) => name.endsWith('.js'))
    .map((name) => [name, gzipSync(readFileSync(join(site, 'assets', name)), { level: 9 }).length]),
)
const sum = (names) => [...names].reduce((bytes, name) => bytes + (sizes.get(name) ?? 0), 0)

for (const [view, there] of [
  ['', 'tbody tr'],
  ['/recording/meteo'],
  ['/search', 'textarea'],
  ['/compose', '.empty button'],
  ['/import', 'input[type=file]'],
  ['/phases/meteo'],
  ['/evaluate', 'form'],
  ['/compare', 'form'],
  ['/guide', 'main button'],
]) {
  test(`#/demo${view} loads little script`, async () => {
    const page = await context.newPage()
    const scripts = new Set()
    page.on('request', (request) => scripts.add(request.url().split('/').at(-1)))
    await page.addInitScript(() => localStorage.setItem('signweave.body', 'drawn'))
    await page.goto(`${address}/#/demo${view}`)
    if (there) await page.locator(there).first().waitFor({ state: 'attached' })
    else await page.waitForFunction(() => window.signweaveStage?.panes[0]?.seen)
    const bytes = sum(scripts)
    await page.close()
    console.log(`script of #/demo${view}, compressed: ${bytes} bytes (at most ${kScriptBytes})`)
    assert.ok(bytes > 10_000 && bytes <= kScriptBytes, `${bytes} bytes`)
  })
}
