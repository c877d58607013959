// What is saved and exported from a search: selection, files, queries; and its limits.
import assert from 'node:assert/strict'
import { answered, asked, button, field, kAll, list, run, saved, status } from './search_tools.mjs'
import { address, page, test, visit } from './suite.mjs'
import { until } from './waits.mjs'

test('says of a stopped search that there may be more', async () => {
  await asked('gloss = "METEO"')
  await page.evaluate(() => {
    const real = window.fetch
    // Two answers arrive, and then no more until it is cancelled.
    window.fetch = (where, init) =>
      !String(where).endsWith('/query')
        ? real(where, init)
        : Promise.resolve(
            new Response(
              new ReadableStream({
                start(stream) {
                  stream.enqueue(new TextEncoder().encode('recording,tier,name,begin ms,end ms\nmeteo,Gloss,A,0,100\nmeteo,Gloss,B,100,200\n'))
                  init.signal.addEventListener('abort', () => stream.error(init.signal.reason))
                },
              }),
            ),
          )
  })
  await field().fill(kAll)
  await page.keyboard.press('Enter')
  await page.getByText('2 so far').waitFor()
  await button('Stop').click()
  await page.waitForFunction(() => document.querySelector('[data-status=stopped]')?.textContent.trim() === 'Stopped after 2 answers; there may be more')
  await page.getByText('Export', { exact: true }).click()
  await page.getByLabel('the 2 found before the search was stopped; there may be more').waitFor()
  await button('What to search for').click()
  await until(async () => assert.equal(await page.locator('section:has(#recent-title) code').first().textContent(), 'gloss = "METEO"'))
})

test('selects answers by key and mouse, saves them in every format, and signs them', async () => {
  await asked('gloss = "VANNES" | gloss = "METEO"', 5)
  await list().focus()
  await page.keyboard.press('ArrowDown')
  await page.keyboard.press('x')
  await page.keyboard.press('End')
  await page.keyboard.press('Shift+X')
  await page.getByText('4 selected', { exact: true }).waitFor()
  await page.getByRole('checkbox', { name: 'Select VANNES' }).nth(1).click()
  await page.getByText('3 selected', { exact: true }).waitFor()
  await page.getByText('Export', { exact: true }).click()
  const csv = await saved(() => button('CSV').click())
  const rows = csv.bytes.toString().trim().split('\n')
  assert.equal(csv.name, 'answers.csv')
  assert.deepEqual([rows.length, rows[0]], [4, 'recording,tier,name,begin ms,end ms'])
  const json = JSON.parse((await saved(() => button('JSON').click())).bytes)
  assert.deepEqual(
    json.map(({ name, begin_ms }) => `${name},${begin_ms}`),
    rows.slice(1).map((row) => row.split(',').slice(2, 4).join()),
  )
  const eaf = await saved(() => button('ELAN', {}).click())
  assert.equal(eaf.name, 'answers_eaf.zip')
  assert.equal(eaf.bytes.toString('latin1').match(/TIER_ID="query 1"/g).length, 2)
  const bvh = await saved(() => button('Motion, BVH').click())
  assert.equal(bvh.name, 'answers_bvh.zip')
  assert.equal(bvh.bytes.toString('latin1').match(/HIERARCHY/g).length, 3)
  // The menu closes by key, and by a click elsewhere.
  await page.keyboard.press('Escape')
  await until(async () =>
    assert.equal(await page.evaluate(() => document.activeElement.matches('summary') && !document.activeElement.parentElement.open), true),
  )
  await page.keyboard.press('Enter')
  await button('CSV').waitFor()
  await status().click()
  await button('CSV').waitFor({ state: 'hidden' })
  await page.getByText('Sign these').click()
  const inAddress = await page.waitForFunction(() => new URLSearchParams(location.hash.split('?')[1]).get('utterance'))
  // Compose rewrites its address a moment later, without unnecessary quotes.
  const utterance = (await inAddress.jsonValue()).replaceAll('"', '')
  const pieces = rows
    .slice(1)
    .map((row) => row.split(','))
    .map(([recording, , , begin, end]) => `${recording}@${begin}..${end}`)
  assert.equal(utterance.split(' ').length, 3)
  assert.deepEqual(utterance.split(' ').toSorted(), pieces.toSorted())
  const made = await fetch(`${address}/api/databases/demo/sign`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ utterance }),
  })
  assert.equal(made.status, 200)
  await until(async () => assert.equal(await page.locator('.card').count(), 3, 'Compose contains the selected answers'))
})

test('saves queries under names, and remembers recent ones', async () => {
  await visit('#/demo/search', { still: true })
  await page.evaluate(() => localStorage.removeItem('signweave.queries'))
  await visit('#/demo/search', { still: true })
  await run('gloss = "VANNES"', 3)
  await button('What to search for').click()
  await page.getByRole('textbox', { name: 'Name' }).fill('tokens')
  await button('Save this query').click()
  await visit('#/demo/search', { still: true })
  await button('Rename tokens').click()
  await page.getByRole('textbox', { name: 'New name' }).fill('all of VANNES')
  await page.keyboard.press('Enter')
  const file = await saved(() => button('Save as a file').click())
  await button('Delete all of VANNES').click()
  await until(async () => assert.equal(await button('Delete all of VANNES').count(), 0))
  await button('Undo').click()
  await until(async () => assert.equal(await button('Delete all of VANNES').count(), 1))
  await button('Delete all of VANNES').click()
  await page.locator('input[type=file]').setInputFiles({ name: file.name, mimeType: 'application/json', buffer: file.bytes })
  await page.getByText('1 queries in the file').waitFor()
  await page.locator('input[type=file]').setInputFiles({ name: 'x.json', mimeType: 'application/json', buffer: Buffer.from('{}') })
  await page.getByText('This is not a file of queries.').waitFor()
  await until(async () => assert.equal(await page.locator('section:has(#recent-title) code').first().textContent(), 'gloss = "VANNES"'))
  await button('all of VANNES', {}).first().click()
  await answered(3)
  // A name that is taken: it is announced before, and can be undone.
  await run('gloss = "METEO"')
  await button('What to search for').click()
  await page.getByRole('textbox', { name: 'Name' }).fill('all of VANNES')
  await button('Replace all of VANNES').click()
  const kept = () => page.locator('section:has(#saved-title) code').allTextContents()
  await until(async () => assert.deepEqual(await kept(), ['gloss = "METEO"']))
  await page.getByText('all of VANNES was replaced').waitFor()
  await button('Undo').click()
  await until(async () => assert.deepEqual(await kept(), ['gloss = "VANNES"']))
})

test('cancels an export when the page is left', async () => {
  await asked('gloss = "VANNES" | gloss = "METEO"', 5)
  let release
  const held = new Promise((resolve) => (release = resolve))
  await page.route(/format=bvh/, async (route) => {
    await held
    await route.continue().catch(() => {})
  })
  let downloads = 0
  page.on('download', () => ++downloads)
  await page.getByText('Export', { exact: true }).click()
  const asking = page.waitForRequest(/format=bvh/),
    given = page.waitForEvent('requestfailed', (request) => /format=bvh/.test(request.url()))
  await button('Motion, BVH').click()
  await asking
  await page.evaluate(() => (location.hash = '#/demo'))
  await given
  release()
  await page.unroute(/format=bvh/)
  assert.equal(downloads, 0)
})
