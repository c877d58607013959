// Proposed phases under review, as a person would check them.
import assert from 'node:assert/strict'
import { execFileSync } from 'node:child_process'
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { annotation, asBefore, button, empty, faultsOf, kSignweave, kViewports, store } from './corpus_tools.mjs'
import { transport } from './page_tools.mjs'
import { address, context, faults, folder, page, test, visit } from './suite.mjs'
import { until } from './waits.mjs'

/** Few pixels are drawn quickly. */
const kSmall = { width: 960, height: 600 }
const draft = () => page.evaluate(() => JSON.parse(localStorage.getItem('signweave.review.mine/plain') ?? 'null')?.review.phases)
const progress = () => page.locator('.progress strong').textContent()
const press = async (...keys) => {
  for (const key of keys) await page.keyboard.press(key)
}
/** Waits until the page of a recording's phases has drawn the signer. */
async function bench() {
  await page.waitForFunction(() => document.querySelector('.bench[data-ready]') && window.signweaveStage?.panes[0]?.seen)
  // Tests the actions of keys and buttons without drawing, which is slow in software.
  await page.evaluate(() => {
    if (window.signweaveStage) window.signweaveStage.touch = () => {}
  })
}
const near = (value, wanted) => assert.ok(Math.abs(value - wanted) < 1e-3, `${value} is not ${wanted}`)
const all = ({ right, left }) => [...right, ...left].toSorted((a, b) => a.begin - b.begin || (a.hand === 'right' ? -1 : 1))

test('reviews proposed phases by keyboard', async () => {
  await store('plain')
  await visit('#/mine/phases/plain', { size: kSmall })
  await bench()
  const count = Number(/0 of (\d+) decided/.exec(await progress())[1])
  assert.ok(count > 4, `${count} proposals`)
  await until(async () => assert.match(await page.locator('main').textContent(), /Proposed from motion alone: each one must be checked by a person/))
  await until(async () =>
    assert.deepEqual((await page.locator('.names li').allTextContents()).filter(Boolean).slice(0, 4), ['Right hand', 'Left hand', 'Gloss', 'Phase']),
  )
  await press('ArrowDown', 'v')
  const proposed = all(await draft())
  const spanOf = async () => (({ loop }) => [loop.begin, loop.end].map((seconds) => Math.round(1000 * seconds)))(await transport(page))
  await until(async () => assert.deepEqual(await spanOf(), [proposed[0].begin, proposed[0].end]))
  await press('Space')
  await page.waitForFunction(
    ([from, to]) =>
      window.signweaveStage.transport.playing && window.signweaveStage.transport.time > from / 1000 && window.signweaveStage.transport.time < to / 1000,
    [proposed[0].begin, proposed[0].end],
  )
  await press('Space', 'Enter', 'Delete')
  await until(async () => assert.equal(await progress(), `2 of ${count} decided`))
  let now = all(await draft())
  assert.deepEqual(
    now.slice(0, 3).map(({ state }) => state),
    ['accepted', 'rejected', 'open'],
  )
  // Moves a border by one frame and by ten; the picture follows.
  const [, , third] = now
  await press('w', 'Shift+P')
  near((await transport(page)).time, (third.end + 100 - 10) / 1000)
  await press('Shift+W')
  near((await transport(page)).time, (third.begin + 110) / 1000)
  await until(async () => assert.deepEqual(await spanOf(), [third.begin + 110, third.end + 100]))
  now = await draft()
  for (const hand of ['right', 'left']) for (let i = 1; i < now[hand].length; ++i) assert.ok(now[hand][i].begin >= now[hand][i - 1].end, 'phases overlap')
  // Split, merge, and all of it undone and redone.
  await press('ArrowRight', 'x')
  await until(async () => assert.equal(await progress(), `2 of ${count + 1} decided`))
  await press('m')
  await until(async () => assert.equal(await progress(), `2 of ${count} decided`))
  for (let i = 0; i < 4; ++i) await page.keyboard.press('Control+z')
  await until(async () => assert.deepEqual(await spanOf(), [third.begin + 10, third.end]))
  for (let i = 0; i < 4; ++i) await press('y')
  await until(async () => assert.deepEqual(await draft(), now))
  await page.keyboard.press('Shift+Enter')
  await until(async () => assert.equal(await progress(), `${count} of ${count} decided`))
  await press('z')
  // The draft is kept until it is stored; letters are shortcuts only if enabled.
  await page.evaluate(() => localStorage.setItem('signweave.keys', 'off'))
  await page.reload()
  await bench()
  await page.evaluate(() => localStorage.removeItem('signweave.keys'))
  await until(async () => assert.equal(await progress(), `2 of ${count} decided`))
  await until(async () => assert.match(await page.locator('main').textContent(), /Continued from your draft/))
  await press('ArrowDown', 'x', 'v')
  await until(async () => assert.deepEqual(await draft(), now))
})

test('reviews phases by mouse and buttons', async () => {
  await visit('#/mine/phases/plain', { size: kSmall })
  await bench()
  await button('Show all').click()
  const lane = await page.getByRole('slider', { name: 'Time' }).boundingBox()
  const { duration } = await transport(page)
  const x = (ms) => lane.x + (ms / 1000 / duration) * lane.width,
    kRight = lane.y + 24 + 12
  const { right } = await draft()
  const one = right.reduce((longest, phase) => (phase.end - phase.begin > longest.end - longest.begin ? phase : longest))
  await page.mouse.click(x((one.begin + one.end) / 2), kRight)
  await page.getByText('Right hand ·').waitFor()
  const read = async () => (await draft()).right.find(({ id }) => id === one.id)
  // The end, dragged: a single step that can be undone.
  await page.mouse.move(x(one.end), kRight)
  await until(async () => assert.equal(await page.locator('.lane').evaluate((element) => element.style.cursor), 'ew-resize'))
  await page.mouse.down()
  await page.mouse.move(x(one.end) - 30, kRight)
  await page.mouse.move(x(one.end) - 60, kRight, { steps: 2 })
  await page.mouse.up()
  await until(async () => {
    const { end } = await read()
    assert.ok(Math.abs(end - (one.end - (60 / lane.width) * duration * 1000)) < 15, `${one.end} became ${end}`)
  })
  await button('Undo').click()
  await until(async () => assert.equal((await read()).end, one.end))
  await button('End: -1 frames').or(button('End: −1 frames')).click()
  await until(async () => assert.equal((await read()).end, one.end - 10))
  await page.getByRole('button', { name: 'hold', exact: true }).click()
  await until(async () => assert.equal((await read()).kind, 'hold'))
  await button('Reject').click()
  await until(async () => assert.equal((await read()).state, 'rejected'))
  for (let i = 0; i < 3; ++i) await button('Undo').click()
  await until(async () => assert.equal((await read()).kind, one.kind))
})

test('overwrites no review that is continued in another window', async () => {
  if (!page?.url().endsWith('#/mine/phases/plain')) await visit('#/mine/phases/plain', { size: kSmall })
  await bench()
  const mine = await draft()
  const other = await context.newPage()
  await other.goto(`${address}/api/formats`)
  const theirs = (label) =>
    other.evaluate(
      ([key, kind]) => {
        const one = JSON.parse(localStorage.getItem(key))
        one.review.phases.right[0].kind = kind
        localStorage.setItem(key, JSON.stringify({ ...one, revision: kind }))
      },
      ['signweave.review.mine/plain', label],
    )
  const kind = async () => (await draft()).right[0].kind
  await theirs('theirs')
  await page.getByText('This review was changed in another window').waitFor()
  await press('ArrowDown', 'ArrowDown', 'v')
  await until(async () => assert.equal(await kind(), 'theirs', 'the last keystroke won'))
  await button('Keep mine').click()
  await until(async () => assert.equal(await kind(), mine.right[0].kind))
  await until(async () => assert.notDeepEqual(await draft(), mine, 'later changes are lost'))
  await theirs('theirs again')
  await button('Use the other window’s review').click()
  await until(async () => assert.equal(await page.getByText('This review was changed').count(), 0))
  await press('Control+z', 'Control+z')
  await until(async () => assert.deepEqual(await draft(), mine))
  // Stored or discarded there: nothing replaces it here without confirmation.
  await other.evaluate(() => localStorage.removeItem('signweave.review.mine/plain'))
  await page.getByText('stored or discarded in another window').waitFor()
  await press('v')
  await until(async () => assert.equal(await draft(), undefined))
  await press('Control+z')
  await button('Keep mine').click()
  await until(async () => assert.deepEqual(await draft(), mine))
  await other.close()
})

test('saves checked phases next to the annotation, as EAF and in the database, and continues from them', async () => {
  await visit('#/mine/phases/plain', { size: kSmall })
  await bench()
  const before = await annotation('plain')
  await press('Shift+Enter', 'ArrowDown', 'Enter')
  await page.getByText('accepted unseen, with all others').or(page.getByText('accepted unseen:')).first().waitFor()
  const { right, left } = await draft()
  const unseen = [...right, ...left].filter((one) => one.unseen).length
  assert.ok(unseen > 0)
  const wanted = {
    'Phase RH (checked)': right.filter(({ state }) => state === 'accepted'),
    'Phase LH (checked)': left.filter(({ state }) => state === 'accepted'),
  }
  await button('Save…').click()
  await page.getByLabel('Checked by').fill('Zoé <b>')
  const coming = page.waitForEvent('download')
  await button('Save as EAF').click()
  const eaf = join(folder, 'checked', 'plain.eaf')
  await (await coming).saveAs(eaf)
  // The program reads it, and every previous line is preserved except one, the last annotation's number.
  const info = execFileSync(kSignweave, ['info', eaf], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] })
  for (const [tier, phases] of Object.entries(wanted)) assert.match(info, new RegExp(`${tier.replace(/[()]/g, '\\$&')} +checked phase +${phases.length}\\b`))
  const written = readFileSync(eaf, 'utf8'),
    lines = new Set(written.split('\n'))
  assert.deepEqual(
    before
      .split('\n')
      .filter((line) => !lines.has(line))
      .map((line) => line.trim().split('"')[1]),
    ['lastUsedAnnotationId'],
  )
  assert.match(written, /ANNOTATOR="signweave, partly checked by Zoé &lt;b&gt;"/)
  assert.match(written, new RegExp(`phases checked by Zoé &lt;b&gt;, ${unseen} accepted all at once without being looked at<`))
  await page.getByText(`${unseen} were accepted all at once`).waitFor()
  const database = join(folder, 'checked', 'round.db')
  execFileSync(kSignweave, ['create', database], { stdio: 'ignore' })
  assert.match(
    execFileSync(kSignweave, ['import', database, eaf, '--phase-tier', 'Phase RH (checked)'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }),
    /plain: added.*36 signs/,
  )
  // In the database: the source of the signs' phases is chosen first. Another annotation stored meanwhile by someone else is reported, and preserved.
  const colleague = (gloss) => store('plain', { motion: false, change: (text) => text.replace('>METEO<', `>${gloss}<`) })
  await colleague('COLLEAGUE')
  await button('Store in the database…').click()
  await page.getByText('This file replaces the annotation of plain in mine').waitFor()
  await page.getByText('Someone else changed the annotation of plain since you began').waitFor()
  await until(async () => assert.ok(await page.getByLabel('unchanged: Phase').isChecked()))
  await colleague('AGAIN')
  await button('Store in the database').click()
  await page.getByText('so nothing was stored yet').waitFor()
  await until(async () => assert.match(await annotation('plain'), />AGAIN</))
  // Nor is an annotation replaced that was stored at the last moment, when the import was already submitted.
  const again = page.waitForResponse('**/uploads/*/inspect')
  await page.route(
    '**/uploads/*/import',
    async (route) => {
      await colleague('LAST')
      await route.continue()
    },
    { times: 1 },
  )
  await button('Store in the database').click()
  await again
  await page.getByLabel('the checked phases: Phase RH (checked)').check()
  await until(async () => assert.match(await annotation('plain'), />LAST</))
  // Success is reported when everything is done, however slowly the server answers.
  const reading = '**/recordings/plain/annotation*'
  await page.route(reading, (route) => void setTimeout(() => void route.continue(), 400))
  await button('Store in the database').click()
  await page.getByText('Stored: annotation replaced').waitFor()
  await page.unroute(reading)
  await until(async () => assert.equal(await annotation('plain'), written.replace('>METEO<', '>LAST<')))
  const query = encodeURIComponent('phase = stroke')
  const strokes = await (await fetch(`${address}/api/databases/mine/query?text=${query}`)).json()
  const ours = strokes.filter(({ recording }) => recording === 'plain')
  assert.ok(ours.length > 0 && ours.every(({ tier }) => tier === 'Phase RH (checked)' || tier === 'Gloss'), JSON.stringify(ours.slice(0, 3)))
  await page.keyboard.press('Escape')
  await until(async () => assert.equal(await draft(), undefined))
  // A second review starts from what was stored.
  await page.reload()
  await bench()
  await until(async () => assert.match(await page.locator('main').textContent(), /Continued from the phases stored with the recording/))
  await until(async () =>
    assert.deepEqual((await page.locator('.names li').allTextContents()).filter(Boolean).slice(0, 4), ['Right hand', 'Left hand', 'Gloss', 'Phase']),
  )
  const decided = Object.values(wanted).flat().length
  await until(async () => assert.equal(await progress(), `${decided} of ${decided} decided`))
  await until(async () => assert.match(await page.locator('.progress').textContent(), new RegExp(`accepted unseen: ${unseen}\\b`)))
  await press('ArrowDown', 'Delete', 'z')
  await until(async () =>
    assert.deepEqual(
      all(await draft()).map(({ begin, end, kind }) => [begin, end, kind]),
      all({ right: wanted['Phase RH (checked)'], left: wanted['Phase LH (checked)'] }).map(({ begin, end, kind }) => [begin, end, kind]),
    ),
  )
})

for (const { name, size, set } of kViewports) {
  test(`an accessibility checker finds nothing in phases, ${name}`, async () => {
    if (!page) await visit('')
    await set()
    await visit('#/mine/phases/plain', { size })
    await bench()
    await press('ArrowDown', 'Enter', 'ArrowDown')
    await page.locator('details summary').click()
    const found = await faultsOf('phases')
    await page.locator('.primary', { hasText: /…/ }).click()
    await page.locator('dialog').waitFor()
    assert.deepEqual([...found, ...(await faultsOf('saving'))], [])
  })
}

test('goes to a phase that ends after the last frame', async () => {
  await store('plain')
  await visit('')
  await page.evaluate(() => localStorage.removeItem('signweave.review.mine/plain'))
  await page.route('**/segment', async (route) => {
    const answer = await (await route.fetch()).json()
    for (const phases of Object.values(answer.hands)) {
      while (phases.at(-1)?.phase === 'rest') phases.pop()
      if (phases.length > 0) phases.at(-1).end_ms += 60_000
    }
    await route.fulfill({ json: answer })
  })
  await page.evaluate(() => (location.hash = '#/mine/phases/plain'))
  await bench()
  const count = Number(/of (\d+) decided/.exec(await progress())[1])
  for (let i = 0; i < count; ++i) await press('ArrowDown')
  // The last phase is repeated up to the last frame.
  await until(async () => {
    const { loop, duration } = await transport(page)
    assert.ok(loop && duration - loop.end < 0.05, `${loop?.end} of ${duration}`)
  })
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))))
  assert.deepEqual(faults, [])
})

test('leaves no trace of the review', async () => {
  await visit('')
  await asBefore()
  await empty()
})
