// Composing loses nothing: neither text with a fault, nor a word when a stream breaks, nor known places next to unknown ones.
import assert from 'node:assert/strict'
import { button, cards, compose, field, pick, shown } from './compose_tools.mjs'
import { axeFaults } from './page_tools.mjs'
import { page, test, visit } from './suite.mjs'
import { signedLive, until } from './waits.mjs'

test('keeps a text with a fault: when moving signs, on undo, and from a link', async () => {
  await compose('VANNES MATIN')
  const typed = 'VANNES MATIN "LE MANS NUAGES'
  await field().fill(typed)
  await page.locator('.card').last().focus()
  await page.getByText(/never closed: "LE MANS/).waitFor()
  await page.keyboard.press('Alt+ArrowLeft')
  await until(async () => assert.deepEqual([await cards(), await field().inputValue()], [['MATIN', 'VANNES'], typed]))
  await field().press('Control+z')
  await until(async () => assert.equal(await field().inputValue(), 'MATIN VANNES'))
  await field().press('Control+y')
  await until(async () => assert.equal(await field().inputValue(), typed))
  await page.getByRole('link', { name: 'Recordings' }).click()
  await page.locator('tbody').first().waitFor()
  await page.goBack()
  await page.locator('.card').first().waitFor()
  await until(async () => assert.equal(await field().inputValue(), typed))
  await button('Discard the text').click()
  await until(async () => assert.deepEqual([await field().inputValue(), await page.getByText(/never closed/).count()], ['MATIN VANNES', 0]))
  await button('Undo').click() // the step made before the other page was opened
  await until(async () => assert.deepEqual(await cards(), ['VANNES', 'MATIN']))
  await visit('#/demo/compose?utterance=VANNES+%22LE+MANS')
  await page.getByText(/never closed: "LE MANS/).waitFor()
  await until(async () => assert.equal(await field().inputValue(), 'VANNES "LE MANS'))
})

test('does not revert an address that was followed a moment ago', async () => {
  await compose('VANNES')
  const later = await page.evaluate(async () => {
    const field = document.querySelector('.compose [role=combobox]')
    const after = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds))
    field.value = 'VANNES MATIN'
    field.dispatchEvent(new Event('input', { bubbles: true }))
    await after(0)
    history.replaceState(null, '', '#/demo') // as a link does before the page receives the event
    await after(300) // Timers end in order: the one that writes the address has ended.
    return location.hash
  })
  assert.equal(later, '#/demo')
})

test('keeps the last change: if the page is left at once, and if a slow task follows', async () => {
  await compose('VANNES')
  await page.locator('.card').click()
  await button('Duplicate').waitFor()
  await page.evaluate(() => {
    ;[...document.querySelectorAll('aside button')].find(({ textContent }) => textContent === 'Duplicate').click()
    location.hash = '#/demo'
  })
  await page.locator('tbody').first().waitFor()
  await page.goBack()
  await page.locator('.card').nth(1).waitFor()
  await until(async () => assert.deepEqual(await cards(), ['VANNES', 'VANNES']))
  let go
  const held = new Promise((resolve) => (go = resolve))
  await page.route('**/recordings/villes', async (route) => (await held, route.continue()))
  await pick('Open', 'villes')
  await page.locator('.card').last().focus()
  await page.keyboard.press('Delete')
  go()
  await page.getByText('villes was not opened, because the signs were changed meanwhile').waitFor()
  await until(async () => assert.deepEqual(await cards(), ['VANNES']))
})

test('keeps the signs while a text is read, and takes no older text for a newer one', async () => {
  await compose('VANNES')
  let go, asked
  const held = new Promise((resolve) => (go = resolve)),
    asking = new Promise((resolve) => (asked = resolve))
  await page.route('**/utterance', async (route) => {
    if (route.request().postDataJSON().text === 'VANNES MATIN ') {
      asked()
      await held
    }
    await route.continue().catch(() => {}) // the page gave the older request up
  })
  await field().fill('VANNES MATIN ')
  await asking
  assert.deepEqual(await cards(), ['VANNES'])
  await field().fill('VANNES PLUIE NUAGES ')
  await until(async () => assert.deepEqual(await cards(), ['VANNES', 'PLUIE', 'NUAGES']))
  go()
  await shown('VANNES PLUIE NUAGES')
  assert.deepEqual([await field().inputValue(), await cards()], ['VANNES PLUIE NUAGES ', ['VANNES', 'PLUIE', 'NUAGES']])
})

test('signs what was typed before the glosses were loaded', async () => {
  await visit('')
  let go
  const held = new Promise((resolve) => (go = resolve))
  await page.route('**/vocabulary*', async (route) => (await held, route.continue()))
  await page.evaluate(() => (location.hash = '#/demo/compose'))
  await field().fill('VANNES')
  go()
  await shown('VANNES')
})

test('prepares files in parallel, and says so', async () => {
  await compose('VANNES')
  let go
  const held = new Promise((resolve) => (go = resolve))
  await page.route('**/sign', async (route) => (await held, route.continue()))
  const files = []
  page.on('download', (file) => files.push(file.suggestedFilename()))
  await pick('Download', /^BVH/)
  await pick('Download', /^EAF/)
  await page.getByText('VANNES.bvh, VANNES.eaf: in preparation…').waitFor()
  const second = new Promise((resolve) => page.on('download', () => files.length === 2 && resolve()))
  go()
  await second
  assert.deepEqual(files.sort(), ['VANNES.bvh', 'VANNES.eaf'])
})

test('shows token costs next to a sign that the database does not know, and after a retry', async () => {
  let broken = true
  await visit('')
  await page.route('**/sign', (route) => (broken ? route.abort() : route.continue()))
  await page.evaluate(() => (location.hash = '#/demo/compose?utterance=NOBODY+VANNES+VANNES'))
  await page.locator('.card').nth(1).click()
  await page.locator('aside .fault:not([hidden])').waitFor()
  broken = false
  await page.locator('.trouble').getByRole('button', { name: 'Try again' }).click()
  await page.locator('aside .token').nth(2).waitFor()
  broken = true
  await page.locator('.card').nth(2).click()
  await page.locator('aside .fault:not([hidden])').waitFor()
  await until(async () => assert.equal(await page.locator('aside .token').count(), 0)) // costs of the other VANNES do not apply to this one
})

test('signs live: each word at once, and reports refused ones', async () => {
  await compose('VANNES')
  await button('Live').click()
  await page.getByRole('combobox', { name: 'Type to sign' }).waitFor()
  await page.keyboard.type('NOBODY MATIN MATIN ') // while the stream is being opened
  await page.waitForFunction(() => window.signweaveStage?.panes[0]?.store.arrived > 0)
  await page.keyboard.type('NOBODY2 MATIN ')
  await signedLive(page, 'MATIN')
  await page.waitForFunction(() => document.querySelectorAll('.card').length === 4)
  await until(async () => assert.match(await page.getByRole('alert').textContent(), /no sign 'NOBODY'[^]*no sign 'NOBODY2'/))
  await until(async () => assert.deepEqual(await cards(), ['VANNES', 'MATIN', 'MATIN', 'MATIN']))
  await page.locator('.card').first().click() // a selection ends it, and opens its panel
  await page.locator('aside .token').first().waitFor()
  await shown('VANNES MATIN MATIN MATIN')
})

test('signs a suggestion for an unknown gloss live, with one click', async () => {
  await compose('VANNES')
  await button('Live').click()
  const live = page.getByRole('combobox', { name: 'Type to sign' })
  await live.waitFor()
  await page.waitForFunction(() => window.signweaveStage?.panes[0]?.store.arrived > 0)
  await live.pressSequentially('PLUIEE MATIN VANES XQZZ ')
  await until(async () => assert.match(await page.getByRole('alert').textContent(), /'PLUIEE'[^]*'VANES'[^]*'XQZZ'/))
  const offered = () => page.getByRole('alert').getByRole('button').allTextContents()
  await until(async () => assert.deepEqual(await offered(), ['PLUIE', 'VANNES', 'NANTES']))
  assert.deepEqual(await axeFaults(page), [])
  await button('Sign NANTES').click()
  // It is signed after what was typed since, its message disappears, and typing continues.
  await until(async () => assert.deepEqual(await cards(), ['VANNES', 'MATIN', 'NANTES']))
  await until(async () => assert.deepEqual(await offered(), ['PLUIE']))
  await until(async () => assert.ok(await live.evaluate((field) => field === document.activeElement)))
  await signedLive(page, 'NANTES')
})

test('loses no word if the stream breaks', async () => {
  let gone = () => {},
    whole = true
  await visit('')
  await page.routeWebSocket(/stream/, (socket) => {
    if (!whole) return socket.close({ code: 1001 })
    const server = socket.connectToServer()
    gone = () => (socket.close({ code: 1001 }), server.close())
  })
  await page.evaluate(() => (location.hash = '#/demo/compose?utterance=VANNES'))
  await shown('VANNES')
  await button('Live').click()
  const live = page.getByRole('combobox', { name: 'Type to sign' })
  await page.waitForFunction(() => document.querySelector('.player.live') && window.signweaveStage?.panes[0]?.store.arrived > 0)
  whole = false
  gone()
  await page.locator('.trouble').waitFor()
  await live.pressSequentially('PLUIE NUAGES ')
  await page.getByText('are in the field again').waitFor()
  await until(async () => assert.deepEqual([await live.inputValue(), await cards()], ['PLUIE NUAGES ', ['VANNES']]))
  whole = true
  await page.locator('.trouble').getByRole('button', { name: 'Try again' }).click()
  await page.waitForFunction(() => !document.querySelector('.trouble, .waits'))
  await until(async () => assert.equal(await live.inputValue(), 'PLUIE NUAGES '))
  await button('Sign').click()
  await page.waitForFunction(() => document.querySelectorAll('.card').length === 3)
  await until(async () => assert.deepEqual([await live.inputValue(), await cards()], ['', ['VANNES', 'PLUIE', 'NUAGES']]))
  whole = false
  gone()
  await page.locator('.trouble').waitFor()
  await live.pressSequentially('MATIN ')
  await page.getByText('are in the field again').waitFor()
  await button('Live').click() // signs that were not signed are added to the row
  await until(async () => assert.deepEqual(await cards(), ['VANNES', 'PLUIE', 'NUAGES', 'MATIN']))
})
