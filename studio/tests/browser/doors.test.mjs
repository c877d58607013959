// Access and return: a server that requires a token, and missing pages.
import assert from 'node:assert/strict'
import { axeFaults } from './page_tools.mjs'
import { withBrowser } from './chromium.mjs'
import { withServer } from './server.mjs'
import { faults, page, plainTest, site, test, visit } from './suite.mjs'
import { opened, until } from './waits.mjs'

test('leads back from a missing recording, and to a suggested one', async () => {
  await visit('#/demo/recording/metoe')
  await page.getByRole('alert').filter({ hasText: 'did you mean meteo?' }).waitFor()
  await page.getByRole('link', { name: 'meteo', exact: true }).click()
  await opened(page, '#/demo/recording/meteo')
  await page.evaluate(() => (location.hash = '#/demo/recording/nowhere'))
  await page.getByRole('link', { name: 'All recordings' }).click()
  await page.waitForFunction(() => location.hash === '#/demo' && document.querySelector('tbody'))
})

const kToken = 'a+token/of:this&test=1'

plainTest('signs in with the server’s token, keeps it over a reload, and shows it nowhere', () =>
  withServer(
    site,
    (address) =>
      withBrowser(
        async (context) => {
          const page = await context.newPage()
          page.on('pageerror', (error) => faults.push(error.message))
          await page.goto(`${address}/#/demo/search`)
          const field = page.getByLabel('Token')
          await field.waitFor()
          assert.deepEqual(await axeFaults(page), [])
          await field.fill('a token that is wrong')
          await page.keyboard.press('Enter')
          await page.getByRole('alert').filter({ hasText: 'The server rejected this token' }).waitFor()
          await field.fill(kToken)
          await page.keyboard.press('Enter')
          // The page in the address is shown, and knows the database.
          await page.locator('#examples-title').waitFor()
          await until(async () => assert.match(await page.locator('section:has(#examples-title)').textContent(), /gloss = "/))
          await page.evaluate(() => (location.hash = '#/demo/compose?utterance=VANNES'))
          await page.waitForFunction(() => document.querySelector('.compose')?.dataset.made === 'VANNES')
          await page.reload()
          await page.waitForFunction(() => document.querySelector('.compose')?.dataset.made === 'VANNES')
          // A live stream sends it, too.
          await page.getByRole('button', { name: 'Live', exact: true }).click()
          await page.getByRole('combobox', { name: 'Type to sign' }).waitFor()
          await page.keyboard.type('MATIN ')
          await page.waitForFunction(() => document.querySelectorAll('.card').length === 2)
          assert.doesNotMatch(page.url(), /token/)
          // Another tab asks again; a token in a link is removed from the address.
          const other = await context.newPage()
          await other.goto(`${address}/#/demo`)
          await other.getByLabel('Token').waitFor()
          await other.goto(`${address}/?token=${encodeURIComponent(kToken)}#/demo`)
          await opened(other, '#/demo')
          await other.getByRole('link', { name: 'meteo' }).waitFor()
          assert.equal(other.url(), `${address}/#/demo`)
        },
        { locale: 'en-GB', colorScheme: 'dark' },
      ),
    undefined,
    { token: kToken },
  ),
)
