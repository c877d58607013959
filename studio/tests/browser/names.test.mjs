// Names that are too long for their space: their distinctive end stays visible.
import assert from 'node:assert/strict'
import { faultsOf } from './corpus_tools.mjs'
import { context, page, test, visit } from './suite.mjs'
import { until } from './waits.mjs'

const kPhone = { width: 390, height: 844 }
const names = Array.from({ length: 20 }, (_, k) => `bulletin-meteo-${k + 1}`)

/** Returns for every name shown: its text, the begin and end that are drawn, and whether the end fits and the begin is cut. */
const shown = (within) =>
  page.locator(`${within} .shown-name`).evaluateAll((all) =>
    all.map((one) => {
      const width = (part) => parseFloat(getComputedStyle(one, part).width)
      const pen = new OffscreenCanvas(1, 1).getContext('2d')
      pen.font = getComputedStyle(one).font
      const room = one.getBoundingClientRect().width
      return {
        text: one.textContent,
        end: one.dataset.end,
        whole: one.dataset.begin + one.dataset.end === one.textContent,
        cut: one.firstChild.scrollWidth > room + 1,
        fits: width('::after') > pen.measureText(one.dataset.end).width - 1 && width('::before') + width('::after') <= room + 0.5,
      }
    }),
  )
/** The server lists many recordings, all like the first. */
const manyRecordings = () =>
  page.route(/\/api\/databases\/demo$/, async (route) => {
    const answer = await (await route.fetch()).json()
    await route.fulfill({ json: { ...answer, recordings: names.map((name) => ({ ...answer.recordings[0], name })) } })
  })

test('the list of recordings keeps the ends of names on a phone', async () => {
  await visit('#/mine', { size: kPhone })
  await manyRecordings()
  await page.evaluate(() => (location.hash = '#/demo'))
  await page.locator('tbody th').nth(9).waitFor()
  const rows = await shown('tbody')
  assert.ok(rows.length >= 10)
  for (const row of rows.filter(({ text }) => text.length > 15))
    assert.deepEqual(row, { text: row.text, end: row.text.slice(9), whole: true, cut: true, fits: true })
  // The whole name is used by screen readers, for searching and for copying.
  const one = page.getByRole('link', { name: 'bulletin-meteo-12', exact: true })
  assert.equal(await one.count(), 1)
  const session = await context.newCDPSession(page)
  const { nodes } = await session.send('Accessibility.getFullAXTree')
  assert.ok(nodes.some(({ role, name }) => role?.value === 'link' && name?.value === 'bulletin-meteo-12'))
  const copied = await one.evaluate((link) => {
    getSelection().selectAllChildren(link)
    return getSelection().toString()
  })
  assert.equal(copied, 'bulletin-meteo-12')
  assert.deepEqual(await faultsOf('names'), [])
  // With enough room nothing is cut.
  await page.setViewportSize({ width: 1280, height: 720 })
  await until(async () => assert.ok((await shown('tbody')).every(({ cut }) => !cut)))
})

test('answers of a search keep the ends of names on a phone, as a table and as a grid', async () => {
  await visit('#/mine', { size: kPhone })
  await page.route(/\/query$/, async (route) => {
    const answer = await route.fetch()
    await route.fulfill({ response: answer, body: (await answer.text()).replace(/\bmeteo\b/g, 'bulletin-meteo-matin-12') })
  })
  for (const [view, place, end] of [
    ['table', '.rows', 'matin-12'],
    ['grid', '.cells', 'tin-12'],
  ]) {
    await page.evaluate((to) => (location.hash = to), `#/demo/search?view=${view}&q=${encodeURIComponent('gloss = "MATIN" & recording = "meteo"')}`)
    await page.locator(`${place} .shown-name`).first().waitFor()
    await until(async () => {
      const [first] = await shown(place)
      assert.deepEqual(first, { text: 'bulletin-meteo-matin-12', end, whole: true, cut: true, fits: true })
    })
  }
})
