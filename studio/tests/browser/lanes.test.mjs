// Texts that give hands, face or gaze something of their own: their lanes on the timeline, in the viewer and where texts are composed.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { button, cards, field, pause, shown } from './compose_tools.mjs'
import { axeFaults, transport } from './page_tools.mjs'
import { kScenario3 } from './server.mjs'
import { kDeclared, mainTest, page, test, visit } from './suite.mjs'
import { until } from './waits.mjs'

const rows = async () => (await page.locator('.names li').allTextContents()).map((name) => name.trim()).filter(Boolean)
const slider = () => page.getByRole('slider', { name: 'Time' })
const saidAt = async (seconds) => {
  await page.evaluate((to) => {
    const { transport } = window.signweaveStage
    transport.pause()
    transport.seek(to)
    window.signweaveStage.touch()
  }, seconds)
  const clock = `0:${String(Math.floor(seconds)).padStart(2, '0')}`
  await until(async () => assert.ok((await slider().getAttribute('aria-valuetext')).startsWith(clock)))
  return slider().getAttribute('aria-valuetext')
}
/** Composes a text of the recordings `mains` and `visage`. */
async function composeLanes(utterance) {
  await visit(`#/channels/compose?${new URLSearchParams({ utterance })}`)
  await shown(utterance)
  await pause()
}
const kHeld = 'REGION{left hold ..OUEST} NORD OUEST'

mainTest('the timeline of a signed text has a row for each lane and each authored channel, which says its sources', async () => {
  await visit(`#/channels/sign/${encodeURIComponent(kScenario3)}`, { still: true, whole: true })
  await until(async () =>
    assert.deepEqual((await rows()).slice(0, 10), ['Gloss', 'Phase', 'Left hand', 'Brows', 'Gaze', 'Mouth', 'Head motion', 'Place', 'Source', 'Junction']),
  )
  const {
    lanes,
    movements,
    frames_per_second: rate,
  } = await page.evaluate(async (utterance) => {
    const body = JSON.stringify({ utterance })
    return (await fetch('api/databases/channels/sign', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body })).json()
  }, kScenario3)
  assert.deepEqual(
    lanes.map(({ channel }) => channel),
    ['left'],
  )
  const middle = ({ begin, end }) => (begin + end) / 2 / rate
  const held = lanes[0].items.find(({ kind }) => kind === 'hold')
  assert.match(await saidAt(middle(held.frames)), /, Left hand: hold: REGION, pose of clip 0, place 0: mains frame \d+/)
  const joined = lanes[0].items.find(({ kind }) => kind === 'transition')
  assert.match(await saidAt(middle(joined.frames)), /, Left hand: taught, clip 0 -> 2: taught \d+ ms/)
  const gaze = movements.find(({ kind }) => kind === 'gaze')
  const said = await saidAt(middle(gaze.frames))
  assert.match(said, /, Left hand: VANNES, clip \d, place 6: \w+ frames \d+\.\.\d+, as the body, Gaze: left, left, with VANNES/)
  assert.match(said, /, Mouth: "vannes", "vannes", with VANNES/)
  // The pointer gets the same where it is, and a click selects the box.
  const box = await slider().boundingBox()
  const { duration } = await transport(page)
  await page.mouse.move(box.x + (middle(held.frames) / duration) * box.width, box.y + 24 + 2 * 25 + 12)
  await until(async () => assert.match(await slider().getAttribute('title'), /^hold: REGION\npose of clip 0/))
  await page.mouse.down()
  await page.mouse.up()
  await until(async () => {
    const { loop } = await transport(page)
    assert.ok(loop && Math.abs(loop.begin - held.frames.begin / rate) < 0.02 && Math.abs(loop.end - held.frames.end / rate) < 0.02, JSON.stringify(loop))
  })
  await page.mouse.move(box.x + 5, box.y + 5)
  await until(async () => assert.equal(await slider().getAttribute('title'), null))
  assert.match(await page.locator('.declarations').textContent(), kDeclared)
  assert.deepEqual(await axeFaults(page), [])
})

mainTest('a text with parts is composed as text: it plays, its lanes are shown, and its signs are not moved', async () => {
  await composeLanes(kHeld)
  await until(async () => assert.deepEqual((await rows()).slice(0, 3), ['Gloss', 'Phase', 'Left hand']))
  assert.deepEqual([await cards(), await field().inputValue()], [['REGION', 'NORD', 'OUEST'], kHeld])
  const note = page.getByText('edit the signs in the text above').first()
  await note.waitFor()
  await page.locator('.card').nth(1).focus()
  for (const key of ['Delete', 'Alt+ArrowLeft']) await page.keyboard.press(key)
  await page.keyboard.press('Enter')
  await page.locator('aside h2').filter({ hasText: 'NORD' }).waitFor()
  assert.deepEqual([await cards(), await field().inputValue(), await button('Duplicate').count()], [['REGION', 'NORD', 'OUEST'], kHeld, 0])
  // A junction keeps its own settings, its pause is in the text.
  await page.locator('.junction').first().click()
  await page.locator('aside h2').filter({ hasText: 'REGION – NORD' }).waitFor()
  assert.equal(await page.locator('aside select').first().isDisabled(), true)
  await page.locator('aside select').nth(1).selectOption('sine')
  await page.waitForFunction(() => /junctions=1%3Dsine/.test(location.hash))
  await shown(kHeld)
  // Another text replaces it, and undo brings it back.
  await field().fill('REGION NORD ')
  await field().press('Enter')
  await shown('REGION NORD')
  await until(async () => assert.equal((await rows()).includes('Left hand'), false))
  assert.equal(await note.count(), 0)
  await button('Undo').click()
  await shown(kHeld)
  await until(async () => assert.equal((await rows()).includes('Left hand'), true))
  assert.deepEqual(await axeFaults(page), [])
})

test('an unfinished bracket is read when it is closed, and a project with parts comes back from its file', async () => {
  await composeLanes('REGION NORD')
  const asked = []
  page.on('request', (request) => request.url().endsWith('/api/utterance') && asked.push(request.postDataJSON().text))
  await field().fill('REGION{brows up; left hold ')
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 200))) // Timers end in order: one that reads the text has ended.
  assert.deepEqual(asked, [])
  await field().fill('REGION{brows up; left hold ..} NORD ')
  await shown('REGION{brows up; left hold ..} NORD')
  await until(async () => assert.deepEqual((await rows()).slice(2, 4), ['Left hand', 'Brows']))
  const [file] = await Promise.all([page.waitForEvent('download'), button('Save project').click()])
  await composeLanes('NORD')
  await page.locator('input[type=file]').setInputFiles({ name: 'held.json', mimeType: 'application/json', buffer: readFileSync(await file.path()) })
  await shown('REGION{brows up; left hold ..} NORD')
  assert.deepEqual(await cards(), ['REGION', 'NORD'])
})
