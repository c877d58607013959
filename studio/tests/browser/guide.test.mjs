// The guided paths: what somebody does in the pages is noticed. Pages are told by their addresses and by what the server was asked.
import assert from 'node:assert/strict'
import { readFileSync, readdirSync } from 'node:fs'
import { fileURLToPath } from 'node:url'
import { join } from 'node:path'
import { axeFaults } from './page_tools.mjs'
import { address, page, test, visit } from './suite.mjs'
import { opened } from './waits.mjs'

const button = (name) => page.getByRole('button', { name, exact: true })
const panel = () => page.getByRole('region', { name: 'Guide' })
const says = (text) => page.waitForFunction((wanted) => document.querySelector('[aria-label=Guide] .words')?.textContent.includes(wanted), text, { timeout: 20_000 })
const go = (hash) => page.evaluate((to) => (location.hash = to), hash)
const forget = () => page.evaluate(() => localStorage.removeItem('signweave.guide'))

test('goes along the demo: notices what was done, is left and taken up again', async () => {
  await visit('#/demo/guide')
  await forget()
  await page.reload()
  await page.getByRole('button', { name: /^Begin\s*I have only the demo/ }).click()
  await says('1/10 Open a recording')
  await page.getByTitle('Open meteo').click()
  await opened(page, '#/demo/recording/meteo')
  await says('2/10 Play it slowly')
  assert.match(await panel().textContent(), /Done: Open a recording/)
  // Nothing lies over what is worked on.
  const below = await page.evaluate(() => document.querySelector('[aria-label=Guide]').getBoundingClientRect().bottom <= document.querySelector('main').getBoundingClientRect().top + 0.5)
  assert.ok(below)
  for (const key of ['<', '<', '<', 'Space']) await page.keyboard.press(key)
  await says('3/10 Select a sign')
  await page.keyboard.press('Space')
  await page.evaluate(() => (window.signweaveStage.transport.seek(2), window.signweaveStage.touch()))
  await page.keyboard.press('g')
  await says('4/10 Search a gloss')
  assert.match(await panel().textContent(), /gloss = "MATIN"/)
  await panel().getByRole('link', { name: 'Go there' }).click()
  await page.waitForFunction(() => location.hash === '#/demo/search')
  await go('#/demo/search?q=gloss+%3D+%22MATIN%22')
  await says('5/10 Look at its tokens')
  await go('#/demo/search?q=gloss+%3D+%22MATIN%22&view=grid')
  await says('6/10 Compose a sentence')

  // It outlives a reload, is left, and taken up where it was.
  await page.reload()
  await says('6/10 Compose a sentence')
  await button('Leave the guide').click()
  assert.equal(await panel().count(), 0)
  await go('#/demo/guide')
  await page.getByText('Step 6 of 10').waitFor()
  assert.equal(await page.locator('li.done').count(), 5)
  await page.getByRole('button', { name: /^Go on\s*I have only the demo/ }).click()
  await says('6/10 Compose a sentence')
  await button('Step back').click()
  await says('Done already')
  await button('Next').click()
  await button('Skip').click()
  await says('7/10 Take another token')
  await button('Done').click()
  await button('Done').click()
  await button('Done').click()
  await says('10/10 Evaluate')
  await panel().getByRole('link', { name: 'Go there' }).click()
  await button('None').click()
  await page.getByRole('button', { name: 'Evaluate', exact: true }).click()
  await says('That was all.')
  await page.getByRole('button', { name: 'Cancel' }).click().catch(() => {}) // where it still runs
  await button('Leave the guide').click()
})

test('goes along with a folder of EAF and BVH into an empty database', async () => {
  const thanks = fileURLToPath(new URL('../../../../shared/data/bvh/signon-thanks', import.meta.url))
  const send = async (where, init = {}) => {
    const answer = await fetch(`${address}/api/${where}`, init)
    assert.ok(answer.ok, `${where}: ${answer.status}`)
    return answer.json()
  }
  await visit('#/mine/guide')
  const { recordings } = await send('databases/mine')
  for (const { name } of recordings) await send(`databases/mine/recordings/${encodeURIComponent(name)}`, { method: 'DELETE' })
  await forget()
  await page.reload()
  await page.getByText('This database is empty').waitFor()
  assert.ok(await page.getByRole('button', { name: /^Begin\s*I have only the demo/ }).isDisabled())
  assert.equal(await page.getByRole('link', { name: 'Import recordings' }).getAttribute('href'), '#/mine/import')
  await page.getByRole('button', { name: /^Begin\s*I have a folder/ }).click()
  await page.waitForFunction(() => location.hash === '#/mine/import')
  await says('1/10 Bring your files')
  for (const step of ['2/10 Check the report', '3/10 Correct a guess', '4/10 Store them']) {
    await button('Done').click()
    await says(step)
  }
  await page.waitForFunction(() => JSON.parse(localStorage.getItem('signweave.guide')).before === 0)
  const { upload } = await send('databases/mine/uploads', { method: 'POST' })
  for (const file of readdirSync(thanks)) await send(`databases/mine/uploads/${upload}/files/${encodeURIComponent(file)}`, { method: 'PUT', body: readFileSync(join(thanks, file)) })
  const { job } = await send(`databases/mine/uploads/${upload}/import`, { method: 'POST' })
  for (let state; state !== 'done'; ({ state } = await send(`jobs/${job}`))) await new Promise((resolve) => setTimeout(resolve, 100))
  await page.reload()
  await says('5/10 Open one')
  await panel().getByRole('link', { name: 'Go there' }).click()
  await page.getByTitle('Open ISL Thanks').click()
  await opened(page, '#/mine/recording/ISL%20Thanks')
  await says('6/10 Find a sign')
  await go('#/mine/search?q=gloss+%3D+%22THANKS%22')
  await says('7/10 Propose phases')
  await button('Skip').click()
  await button('Skip').click()
  await go('#/mine/compose?u=THANKS')
  await says('10/10 Export')
  await button('Done').click()
  await says('That was all.')
  await forget()
})

for (const [theme, language] of [['dark', 'en'], ['light', 'fr']]) {
  for (const size of [{ width: 1280, height: 720 }, { width: 390, height: 844 }]) {
    test(`an accessibility checker finds nothing in the guide, ${theme}, ${language}, ${size.width} wide`, async () => {
      await page.evaluate(([t, l]) => (localStorage.setItem('signweave.theme', t), localStorage.setItem('signweave.language', l)), [theme, language])
      await visit('#/demo/guide', { size })
      const found = []
      const look = async (name) => {
        found.push(...(await axeFaults(page)).map((fault) => `${name}: ${fault}`))
        assert.ok(await page.evaluate(() => document.scrollingElement.scrollWidth <= innerWidth), `${name} is wider than the screen`)
      }
      await page.locator('form button.primary:enabled').first().waitFor()
      await look('paths')
      await page.locator('form button.primary').first().click()
      await page.waitForSelector('.guide section')
      await page.waitForSelector('main table')
      await look('strip')
      const height = await page.evaluate(() => document.querySelector('.guide').getBoundingClientRect().height)
      assert.ok(height < (size.width > 640 ? 60 : 110), `${height} pixels`)
      await page.evaluate(() => ['theme', 'language', 'guide'].forEach((key) => localStorage.removeItem(`signweave.${key}`)))
      assert.deepEqual(found, [])
    })
  }
}
