// The start page, and the pages of an empty database.
import assert from 'node:assert/strict'
import { asBefore, empty, faultsOf, files, kViewports, store } from './corpus_tools.mjs'
import { kDeclared, mainTest, page, test, visit } from './suite.mjs'
import { until } from './waits.mjs'

const link = (name) => page.getByRole('link', { name, exact: true })
const at = (hash) => page.waitForFunction((wanted) => location.hash === wanted, hash)
/** Mocks the list of databases. */
const serving = (databases) => page.route(/\/api\/databases$/, (route) => route.fulfill({ json: { databases } }))
const row = (name, more = {}) => ({ name, recordings: 3, writable: false, declarations: {}, ...more })
const card = (name) => page.getByRole('article').filter({ has: page.getByRole('heading', { name }) })

mainTest('the start page says what this is, and leads to the demo, to one’s own files and to the first steps', async () => {
  await visit('')
  await page.getByRole('heading', { level: 2, name: 'Captured signing, stored as motion and as meaning' }).waitFor()
  await until(async () => assert.match(await page.locator('main').textContent(), /does not translate/))
  await until(async () => assert.match(await card('Explore the demo').textContent(), kDeclared))
  assert.equal(await page.title(), 'signweave studio')
  for (const [name, hash, there] of [
    ['Open demo', '#/demo', 'tbody tr'],
    ['Compose with it', '#/demo/compose', '.compose'],
    ['Import into mine', '#/mine/import', '.drop'],
    ['First steps', '#/demo/guide', 'form'],
    ['mine', '#/mine', '.empty, tbody tr'],
  ]) {
    await page.locator('main').getByRole('link', { name, exact: true }).click()
    await at(hash)
    await page.locator(there).first().waitFor()
    // The program's name leads back from every page.
    await page.getByRole('banner').getByRole('link', { name: 'signweave' }).click()
    await at('#/')
    await page.locator('#home-title').waitFor()
  }
})

test('the start page updates the number of recordings of every database', async () => {
  await empty()
  await visit('#/')
  const listed = () => page.getByRole('region', { name: 'Databases here' }).getByRole('listitem').allTextContents()
  await until(async () => assert.match((await listed()).join('\n'), /demo\s*2 recordings\s*writable.*not LSF\s*\n\s*mine\s*empty/))
  await link('mine').click()
  await page.getByText('Nothing here yet').waitFor()
  await store('counted', { seconds: 1 })
  await page.goBack()
  await until(async () => assert.match((await listed()).join('\n'), /mine\s*1 recording\s*writable/))
  await empty()
})

test('imports files dropped on the start page into a database that is not a demo', async () => {
  await visit('')
  await page.locator('#home-title').waitFor()
  const mouse = await page.context().newCDPSession(page)
  const data = { items: [], files: files('start', { seconds: 1 }), dragOperationsMask: 1 }
  for (const type of ['dragEnter', 'dragOver', 'drop']) await mouse.send('Input.dispatchDragEvent', { type, x: 640, y: 300, data })
  await at('#/mine/import')
  await page.getByText(/^Files: 2,/).waitFor()
})

test('the start page can be reached from an address of something missing', async () => {
  await visit('#/nowhere')
  await page.getByRole('alert').waitFor()
  await link('Home').click()
  await at('#/')
  await page.locator('#home-title').waitFor()
})

test('explains how to create a database if there is none, and how to serve a writable one', async () => {
  await visit('#/demo')
  await serving([])
  await page.evaluate(() => (location.hash = '#/'))
  await page.getByRole('heading', { name: 'No database is served here yet' }).waitFor()
  await until(async () => assert.match(await page.locator('pre').textContent(), /^signweave create mine\.db\nsignweave import/))
  assert.equal(await page.getByRole('article').count(), 0)
  await page.unroute(/\/api\/databases$/)
  await serving([row('corpus')])
  await page.reload()
  await until(async () => assert.match(await card('Use your own files').textContent(), /read-only access to its databases.*--writable/s))
  // No demo is served, so none is offered; with a single database its pages are in the header.
  assert.equal(await card('Explore the demo').count(), 0)
  assert.equal(await link('Search').getAttribute('href'), '#/corpus/search')
})

test('an empty database accepts files, by hand or from the command line', async () => {
  await empty()
  await visit('#/mine')
  await page.getByText('Nothing here yet').waitFor()
  assert.equal(await page.getByRole('table').count(), 0)
  assert.equal(await page.getByRole('searchbox').count(), 0)
  await until(async () => assert.equal(await page.locator('.empty pre').textContent(), 'signweave import mine.db FOLDER'))
  await link('Import').click()
  await at('#/mine/import')
  // A read-only database has no buttons that would be refused.
  await page.evaluate(() => (location.hash = '#/mine/search'))
  await serving([row('demo'), row('mine', { recordings: 0 })])
  await page.evaluate(() => (location.hash = '#/mine'))
  await page.getByText('The server has read-only access to mine').waitFor()
  assert.equal(await link('Import').count(), 0)
})

for (const { name, size, set } of kViewports) {
  test(`an accessibility checker finds nothing on the start page and in an empty database, ${name}`, async () => {
    if (!page) await visit('')
    await set()
    const found = []
    await visit('', { size })
    await page.locator('#home-title').waitFor()
    found.push(...(await faultsOf('start')))
    await visit('#/mine', { size })
    await page.locator('.empty').waitFor()
    found.push(...(await faultsOf('empty')))
    // The link to the start page is visible on every page, also on a phone.
    const box = await page.locator('header h1 img').boundingBox()
    assert.ok(box.width >= 20 && box.x >= 0 && (await page.locator('.app > .head').boundingBox()).height < 60)
    await asBefore()
    assert.deepEqual(found, [])
  })
}
