// The guided paths: the user's actions in the pages are detected from their addresses and from calls to the server.
import assert from 'node:assert/strict'
import { existsSync, readFileSync, readdirSync } from 'node:fs'
import { join } from 'node:path'
import { annotation, button, empty, files, kThanks, kViewports } from './corpus_tools.mjs'
import { axeFaults } from './page_tools.mjs'
import { page, test, visit } from './suite.mjs'
import { opened, until } from './waits.mjs'

const panel = () => page.getByRole('region', { name: 'Guide' })
const says = (text) => page.waitForFunction((wanted) => document.querySelector('[aria-label=Guide] .words')?.textContent.includes(wanted), text)
const go = (hash) => page.evaluate((to) => (location.hash = to), hash)
const forget = () => page.evaluate(() => localStorage.removeItem('signweave.guide'))

test('follows the demo path: notices finished steps, can be left and continued', async () => {
  await visit('#/demo/guide')
  await forget()
  await page.reload()
  await page.getByRole('button', { name: /^Begin\s*I have only the demo/ }).click()
  await says('1/10 Open a recording')
  await page.getByTitle('Open meteo').click()
  await opened(page, '#/demo/recording/meteo')
  await says('2/10 Play it slowly')
  await until(async () => assert.match(await panel().textContent(), /Done: Open a recording/))
  // Nothing covers the controls.
  const below = await page.evaluate(
    () => document.querySelector('[aria-label=Guide]').getBoundingClientRect().bottom <= document.querySelector('main').getBoundingClientRect().top + 0.5,
  )
  assert.ok(below)
  for (const key of ['<', '<', '<', 'Space']) await page.keyboard.press(key)
  await says('3/10 Select a sign')
  await page.keyboard.press('Space')
  await page.evaluate(() => (window.signweaveStage.transport.seek(2), window.signweaveStage.touch()))
  await page.keyboard.press('g')
  await says('4/10 Search for a gloss')
  await until(async () => assert.match(await panel().textContent(), /gloss = "MATIN"/))
  await panel().getByRole('link', { name: 'Go there' }).click()
  await page.waitForFunction(() => location.hash === '#/demo/search')
  await go('#/demo/search?q=gloss+%3D+%22MATIN%22')
  await says('5/10 View its tokens')
  await go('#/demo/search?q=gloss+%3D+%22MATIN%22&view=grid')
  await says('6/10 Compose a sentence')

  // It outlives a reload, can be left, and continues from the same step.
  await page.reload()
  await says('6/10 Compose a sentence')
  await button('Leave the guide').click()
  await until(async () => assert.equal(await panel().count(), 0))
  await go('#/demo/guide')
  await page.getByText('Step 6 of 10').waitFor()
  await until(async () => assert.equal(await page.locator('li.done').count(), 5))
  await page.getByRole('button', { name: /^Continue\s*I have only the demo/ }).click()
  await says('6/10 Compose a sentence')
  await button('Previous step').click()
  await says('Already done')
  await button('Next').click()
  await button('Skip').click()
  await says('7/10 Choose another token')
  await go('#/demo/compose?utterance=MATIN+PLUIE+VANNES')
  await page.waitForFunction(() => window.signweaveStage?.panes[0]?.seen)
  await page
    .getByRole('button', { name: /^MATIN/ })
    .first()
    .click()
  await page.getByRole('button', { name: /^#1 meteo/ }).click()
  await says('8/10 Change a transition')
  await page
    .getByRole('button', { name: /junction/i })
    .first()
    .click()
  await page.getByLabel('Transition').first().selectOption('overlap')
  await says('9/10 Download or share')
  await page.waitForFunction(() => /junctions/.test(location.hash))
  await button('Download').click()
  const [file] = await Promise.all([page.waitForEvent('download'), page.locator('.list').getByRole('button', { name: /^EAF/ }).click()])
  await until(async () => assert.match(readFileSync(await file.path(), 'utf8'), /overlap \d+ ms: MATIN/))
  await says('10/10 Evaluate')
  await panel().getByRole('link', { name: 'Go there' }).click()
  await button('None').click()
  await page.getByRole('button', { name: 'Evaluate', exact: true }).click()
  await says('This was the last step.')
  await page
    .getByRole('button', { name: 'Cancel' })
    .click()
    .catch(() => {}) // if it is still running
  await button('Leave the guide').click()
})

/** Real signing if available, which is not everywhere; otherwise some of the demo's, so that the path is tested in any case. */
const folderOf = () => {
  if (existsSync(kThanks)) return { paths: readdirSync(kThanks).map((file) => join(kThanks, file)), first: 'ISL Thanks', gloss: 'THANKS', count: 3 }
  console.log('not run: no shared data (the guide runs with recordings of the demo)')
  return { paths: [...files('thanks', { seconds: 51 }), ...files('others', { seconds: 51 })], first: 'thanks', gloss: 'MATIN', count: 2 }
}

test('follows the path of a folder of EAF and BVH, from an empty database to a file', async () => {
  await visit('#/mine/guide')
  await empty()
  await forget()
  await page.reload()
  page.on('dialog', (dialog) => dialog.accept())
  await page.getByText('This database is empty').waitFor()
  await until(async () => assert.ok(await page.getByRole('button', { name: /^Begin\s*I have only the demo/ }).isDisabled()))
  await until(async () => assert.equal(await page.getByRole('link', { name: 'Import recordings' }).getAttribute('href'), '#/mine/import'))
  await page.getByRole('button', { name: /^Begin\s*I have a folder/ }).click()
  await page.waitForFunction(() => location.hash === '#/mine/import')
  await says('1/10 Add your files')
  const { paths, first, gloss, count } = folderOf(),
    real = first === 'ISL Thanks'
  await page.locator('input[type=file]:not([webkitdirectory])').setInputFiles(paths)
  await button('Send and inspect').click()
  await says('2/10 Check the report')
  await page.getByRole('heading', { name: 'What would be stored' }).waitFor()
  await panel().getByRole('button', { name: 'Done' }).click()
  await says('3/10 Correct a guess')
  if (real) await page.getByRole('button', { name: /^Fix all \d with this notice$/ }).click()
  else await panel().getByRole('button', { name: 'Skip' }).click()
  await says('4/10 Store them')
  await page.waitForFunction(() => !/inspecting again/.test(document.querySelector('main').textContent))
  await button(`Import ${count}`).click()
  await says('5/10 Open one')
  await panel().getByRole('link', { name: 'Go there' }).click()
  await page.getByTitle(`Open ${first}`).click()
  await opened(page, `#/mine/recording/${encodeURIComponent(first)}`)
  // Real recordings are not marked as placeholders because the demo is served, too.
  if (real) await until(async () => assert.equal(await page.getByText('placeholder').count(), 0))
  await says('6/10 Find a sign')
  await panel().getByRole('link', { name: 'Go there' }).click()
  await page.locator('.field textarea').fill(`gloss = "${gloss}"`)
  await page.locator('.field textarea').press('Escape')
  await page.locator('.field textarea').press('Control+Enter')
  await says('7/10 Propose phases')
  await until(async () => assert.match(await page.locator('[data-status]').textContent(), /^\s*[1-9]\d* answers/))
  await panel().getByRole('link', { name: 'Go there' }).click()
  await page.getByRole('button', { name: new RegExp(`Details of ${first}`) }).click()
  await page.getByRole('link', { name: 'Phases' }).click()
  await says('8/10 Check some')
  await page.waitForFunction(() => document.querySelector('.bench[data-ready]') && window.signweaveStage?.panes[0]?.seen)
  for (const key of ['ArrowDown', 'Enter', 'p', 'Delete', 'Shift+Enter']) await page.keyboard.press(key)
  await button('Save…').click()
  await button('Store in the database…').click()
  await button('Store in the database').click()
  await says('9/10 Compose with it')
  await page.getByText('Stored: annotation replaced').waitFor()
  await button('Close').click()
  await until(async () => assert.match(await annotation(first), /Phase RH \(checked\)/))
  await panel().getByRole('link', { name: 'Go there' }).click()
  await page.getByRole('combobox', { name: 'Glosses in order' }).fill(gloss)
  await says('10/10 Export')
  await page.waitForFunction(() => window.signweaveStage?.panes[0]?.seen)
  await button('Download').click()
  const [file] = await Promise.all([page.waitForEvent('download'), page.locator('.list').getByRole('button', { name: /^BVH/ }).click()])
  await until(async () => assert.match(readFileSync(await file.path(), 'utf8'), /^HIERARCHY/))
  await says('This was the last step.')
  await forget()
  await empty()
})

for (const { size, name, set } of kViewports) {
  test(`an accessibility checker finds nothing in the guide, ${name}`, async () => {
    await set()
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
    await look('panel')
    const height = await page.evaluate(() => document.querySelector('.guide').getBoundingClientRect().height)
    assert.ok(height < (size.width > 640 ? 60 : 110), `${height} pixels`)
    await page.evaluate(() => ['theme', 'language', 'guide'].forEach((key) => localStorage.removeItem(`signweave.${key}`)))
    assert.deepEqual(found, [])
  })
}
