// Files dropped on any page: they lead to the import, and the browser never shows them in place of the studio.
import assert from 'node:assert/strict'
import { writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { withBrowser } from './chromium.mjs'
import { button, files, kViewports, asBefore } from './corpus_tools.mjs'
import { axeFaults } from './page_tools.mjs'
import { withServer } from './server.mjs'
import { context, faults, folder, mainTest, page, plainTest, site, test, visit } from './suite.mjs'
import { opened, until } from './waits.mjs'

/**
 * A mouse that drags files of the disk, or a text, over a page, as from a desktop. Browsers report a drag several times a second until it is dropped or leaves,
 * and the studio takes a second without a report as the end: so this reports, too.
 */
const mouseOf = async (on, { paths = [], text, x = 640, y = 400 } = {}) => {
  const session = await on.context().newCDPSession(on)
  const data = { items: text ? [{ mimeType: 'text/plain', data: text }] : [], files: paths, dragOperationsMask: 1 }
  const does = (type) => session.send('Input.dispatchDragEvent', { type, x, y, data })
  let reports
  const ends = async (type) => {
    clearInterval(reports)
    await does(type)
  }
  return {
    over: async () => {
      await does('dragEnter')
      await does('dragOver')
      // Until it ends, or the page closes during the drag.
      reports = setInterval(() => does('dragOver').catch(() => clearInterval(reports)), 200)
    },
    drop: () => ends('drop'),
    leave: () => ends('dragCancel'),
  }
}
const overlay = (on = page) => on.locator('.over[popover]')
const line = (on = page) => on.locator('.line[role=alert]')
const listed = () => page.locator('.list .line:not(.head) > :nth-child(1)').allTextContents()
const gone = (on = page) => until(async () => assert.equal(await overlay(on).count(), 0))
async function dropFiles(paths, on = page) {
  const mouse = await mouseOf(on, { paths })
  await mouse.over()
  await overlay(on).waitFor()
  await mouse.drop()
  await gone(on)
}

mainTest('files dropped on the list of recordings appear in the import, with their folders', async () => {
  await visit('#/mine')
  const week = join(folder, 'drop week')
  files('monday', { into: join(week, 'early'), seconds: 1 })
  const mouse = await mouseOf(page, { paths: [week, ...files('alone', { seconds: 1 })] })
  await mouse.over()
  await until(async () => assert.match(await overlay().textContent(), /Drop recordings and annotations to import them into mine/))
  await mouse.drop()
  await page.waitForFunction(() => location.hash === '#/mine/import')
  await page.getByText(/^Files: 4,/).waitFor()
  await gone()
  await until(async () => assert.deepEqual(await listed(), ['alone.bvh', 'alone.eaf', 'drop week/early/monday.bvh', 'drop week/early/monday.eaf']))
  // Back leads to the page on which they were dropped.
  await page.goBack()
  await page.waitForFunction(() => location.hash === '#/mine')
  // Later files are added to the existing ones.
  await dropFiles(files('more', { seconds: 1 }))
  await page.getByText(/^Files: 6,/).waitFor()
  assert.equal(context.pages().filter((one) => /\.(bvh|eaf)/.test(one.url())).length, 0)
})

for (const [hash, there] of [
  ['#/demo/recording/meteo'],
  ['#/demo/search', 'textarea'],
  ['#/demo/compose', '.empty button'],
  ['#/demo/phases/meteo', '.bench[data-ready]'],
  ['#/demo/evaluate', 'form'],
  ['#/demo/compare', 'form'],
  ['#/demo/guide', 'form'],
  ['#/demo/import', '.drop'],
]) {
  test(`${hash} accepts dropped files, once`, async () => {
    await visit(hash, { still: true })
    if (there) await page.locator(there).first().waitFor()
    const mouse = await mouseOf(page, { paths: files('anywhere', { seconds: 1 }) })
    await mouse.over()
    // The import page has a target of its own.
    await page.locator(there === '.drop' ? '.drop.over' : '.over[popover]').waitFor()
    await mouse.drop()
    await page.waitForFunction(() => location.hash === '#/demo/import')
    await page.getByText(/^Files: 2,/).waitFor()
    await gone()
  })
}

test('the compose page keeps its own drops: a project is opened, and not imported', async () => {
  await visit('#/demo/compose')
  await page.locator('.empty button').first().waitFor()
  const path = join(folder, 'x.signweave.json')
  writeFileSync(path, JSON.stringify({ format: 'signweave utterance', colour: 'red' }))
  const mouse = await mouseOf(page, { paths: [path] })
  await mouse.over()
  await page.getByText('Release to open the project').waitFor()
  assert.equal(await overlay().count(), 0)
  await mouse.drop()
  await page.getByText('x.signweave.json: ').waitFor()
  assert.match(page.url(), /#\/demo\/compose/)
})

test('dragged text is handled as usual', async () => {
  await visit('#/demo/search')
  const field = page.locator('.field textarea')
  await field.waitFor()
  const { x, y } = await field.boundingBox()
  const mouse = await mouseOf(page, { text: 'VANNES', x: x + 20, y: y + 10 })
  await mouse.over()
  assert.equal(await overlay().count(), 0)
  await mouse.drop()
  await until(async () => assert.match(await field.inputValue(), /VANNES/))
})

test('the drop hint disappears when the files leave, and stays while they move over elements', async () => {
  await visit('#/mine')
  const mouse = await mouseOf(page, { paths: files('leaves', { seconds: 1 }) })
  await mouse.over()
  await overlay().waitFor()
  await page.evaluate(() => {
    const [from, to] = [document.querySelector('main'), document.querySelector('header')]
    const transfer = new DataTransfer()
    transfer.items.add(new File(['x'], 'x.bvh'))
    for (let i = 0; i < 3; ++i) from.dispatchEvent(new DragEvent('dragleave', { bubbles: true, relatedTarget: to, dataTransfer: transfer }))
  })
  assert.equal(await overlay().count(), 1)
  await mouse.leave()
  await gone()
  assert.match(page.url(), /#\/mine$/)
})

test('rejects files while a dialog is open, and says so above it', async () => {
  await visit('#/mine')
  await page.keyboard.press('?')
  await page.getByRole('dialog').waitFor()
  await dropFiles(files('dialog', { seconds: 1 }))
  await until(async () => assert.match(await line().textContent(), /Close the open dialog/))
  assert.match(page.url(), /#\/mine$/)
  await page.keyboard.press('Escape')
  await button('Close this message').click()
  await until(async () => assert.equal(await line().count(), 0))
})

test('rejects files during an import, and says so', async () => {
  await visit('#/mine/import')
  await page.locator('.drop').waitFor()
  await page.locator('input[type=file]:not([webkitdirectory])').setInputFiles(files('first', { seconds: 1 }))
  let free
  const held = new Promise((resolve) => (free = resolve))
  await page.route(/\/files\//, async (route) => (await held, await route.continue()))
  await button('Send and inspect').click()
  await page.locator('progress').first().waitFor()
  await page.evaluate(() => (location.hash = '#/mine/search'))
  await page.locator('.field textarea').waitFor()
  await dropFiles(files('second', { seconds: 1 }))
  await until(async () => assert.match(await line().textContent(), /An import into mine is in progress/))
  assert.match(page.url(), /#\/mine\/search/)
  free()
  await page.evaluate(() => (location.hash = '#/mine/import'))
  await page.getByRole('heading', { name: 'What would be stored' }).waitFor()
  await until(async () => assert.deepEqual(await page.locator('.report .name').allTextContents(), ['first']))
})

const kToken = 'a-token-of-this-test'
plainTest('rejects files without signing in and with read-only access, and says so', () =>
  withServer(
    site,
    (at, made) =>
      withBrowser(
        async (browser) => {
          const path = join(made, 'corpus', 'meteo.eaf')
          const on = await browser.newPage()
          on.on('pageerror', (error) => faults.push(error.message))
          await on.goto(`${at}/#/demo`)
          await on.getByLabel('Token').waitFor()
          await dropFiles([path], on)
          await until(async () => assert.match(await line(on).textContent(), /Sign in before/))
          await on.getByLabel('Token').fill(kToken)
          await on.keyboard.press('Enter')
          await on.getByRole('link', { name: 'meteo' }).waitFor()
          const mouse = await mouseOf(on, { paths: [path] })
          await mouse.over()
          await until(async () => assert.match(await overlay(on).textContent(), /Files cannot be imported into demo: the server has read-only access to it/))
          await mouse.drop()
          await until(async () => assert.match(await line(on).textContent(), /the server has read-only access to it/))
          await until(async () => assert.deepEqual(await axeFaults(on), []))
          assert.equal(on.url(), `${at}/#/demo`)
          // On the import page, too.
          await on.goto(`${at}/#/demo/import`)
          await opened(on, '#/demo/import')
          await dropFiles([path], on)
          await line(on).waitFor()
          assert.equal(on.url(), `${at}/#/demo/import`)
          assert.equal(browser.pages().filter((one) => one.url().endsWith('.eaf')).length, 0)
        },
        { locale: 'en-GB', colorScheme: 'dark' },
      ),
    undefined,
    { token: kToken },
  ),
)

for (const { name, size, set } of kViewports) {
  test(`an accessibility checker finds nothing while files are dragged, ${name}`, async () => {
    if (!page) await visit('')
    await set()
    await visit('#/mine', { size })
    const mouse = await mouseOf(page, { paths: files('looks', { seconds: 1 }), x: 180, y: 300 })
    await mouse.over()
    await overlay().waitFor()
    assert.deepEqual(await axeFaults(page), [])
    await mouse.leave()
    await asBefore()
  })
}
