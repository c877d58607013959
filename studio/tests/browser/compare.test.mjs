// The blind study: set up, taken by keyboard and mouse, saved, viewed, deleted.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { axeFaults, transport } from './page_tools.mjs'
import { kViewports } from './corpus_tools.mjs'
import { address, context, kDeclared, page, test, visit } from './suite.mjs'
import { frames, until } from './waits.mjs'

const button = (name) => page.getByRole('button', { name, exact: true })
const kept = () => page.evaluate(() => JSON.parse(localStorage.getItem('signweave.study.demo')))
const forget = () => page.evaluate(() => (localStorage.removeItem('signweave.study.demo'), sessionStorage.removeItem('signweave.study.turn.demo')))
/** Sections meant only for the person running the study are collapsed. */
const forMaker = () => page.locator('summary', { hasText: 'For the person running the study' }).click()
/** Waits until both signers of a trial are drawn. */
const seen = (count = 2) =>
  page.waitForFunction((n) => window.signweaveStage?.panes.length === n && window.signweaveStage.panes.every((pane) => pane.seen), count)
/** Parses the votes' CSV into fields, which may be quoted. */
function parsed(text) {
  const rows = [...text.matchAll(/((?:"(?:[^"]|"")*"|[^",\r\n]*)(?:,(?:"(?:[^"]|"")*"|[^",\r\n]*))*)\r\n/g)].map(([, line]) =>
    [...line.matchAll(/(?:^|,)("(?:[^"]|"")*"|[^",]*)/g)].map(([, field]) => field.replace(/^"|"$/g, '').replaceAll('""', '"')),
  )
  return rows.slice(1).map((row) => Object.fromEntries(row.map((field, i) => [rows[0][i], field])))
}
async function saved(name) {
  const [download] = await Promise.all([page.waitForEvent('download'), button(name).click()])
  return readFileSync(await download.path(), 'utf8').replace(/^\ufeff/, '')
}
/** A small still picture is drawn quickly by software. */
const kSmall = { width: 720, height: 560 }
/** Sets up a study; `more` changes the form before. With reduced motion nothing plays automatically. */
async function setUp({ methods = ['hermite', 'sine'], trials = 4, still = true, more = async () => {} } = {}) {
  await visit('#/demo/compare', { size: kSmall })
  if (still) await page.emulateMedia({ reducedMotion: 'reduce' })
  await forget()
  await page.reload()
  await button('Set up the study').waitFor()
  for (const method of ['taught', 'gap']) if (!methods.includes(method)) await page.getByRole('checkbox', { name: method, exact: true }).uncheck()
  for (const method of methods) await page.getByRole('checkbox', { name: method, exact: true }).check()
  await page.getByLabel('Trials per viewer').fill(String(trials))
  await more()
  await page.waitForFunction(() => document.querySelector('form button.primary')?.disabled === false)
  await button('Set up the study').click()
  await button('Begin').waitFor()
}
async function begin(fluency = 'Deaf signer') {
  await page.getByLabel(fluency).check()
  await button('Begin').click()
}
/** The close event of a dialog comes later. */
const closed = () => page.waitForFunction(() => !document.querySelector('dialog'))
const answered = (count) =>
  page.waitForFunction(
    (n) => JSON.parse(localStorage.getItem('signweave.study.demo')).sessions.reduce((sum, { answers }) => sum + answers.length, 0) === n,
    count,
  )

test('a viewer takes part by keyboard alone, a reload continues the same trial, and the votes are saved', async () => {
  await setUp({
    trials: 4,
    more: async () => {
      await page.getByLabel('with the capture twice').fill('1')
      await page.getByLabel('Which looks more natural').check()
      await page.getByLabel('Seed').fill('5')
      await page.locator('summary').click()
      await page.getByLabel('Question: natural, English').fill('Which do you like?')
    },
  })
  const { items, settings } = await kept()
  assert.deepEqual(items.map(({ method }) => method).toSorted(), ['', 'hermite', 'hermite', 'sine', 'sine'])
  assert.equal(new Set(items.map(({ from, recording }) => `${recording} ${from}`)).size, 5)
  assert.equal(settings.seed, 5)
  // By keyboard: the code is preset, Tab to the fluency, space selects, Enter begins.
  await page.getByLabel('Your code').focus()
  await page.keyboard.press('Tab')
  await page.keyboard.press('Space')
  await page.keyboard.press('Enter')
  await seen()
  await until(async () => assert.match((await page.locator('[role=status]').allTextContents()).join(), kDeclared))
  await page.getByText('Which do you like?').waitFor()
  await until(async () => assert.equal((await transport(page)).playing, false))
  await page.keyboard.press('Space')
  await page.waitForFunction(() => window.signweaveStage.transport.time > 0)
  await page.keyboard.press('Space')
  const before = await kept()
  assert.deepEqual([before.current, before.sessions[0].fluency], [undefined, 'deaf']) // only this tab knows the current participant
  // Only Pause leads away.
  await until(async () => assert.equal(await page.locator('nav:visible').count(), 0))
  await page.keyboard.press('?')
  await until(async () => assert.equal(await page.getByRole('dialog').count(), 0))
  await until(async () =>
    assert.deepEqual(
      await page
        .locator('.title')
        .allTextContents()
        .then((all) => all.map((one) => one.trim())),
      ['A', 'B'],
    ),
  )
  await page.keyboard.press('1') // the first question
  await page.keyboard.press('Enter')
  await page.keyboard.press('ArrowRight') // the second
  await page.waitForFunction(() => JSON.parse(localStorage.getItem('signweave.study.demo')).sessions[0].draft?.natural === 'right')
  await page.reload()
  await seen()
  await until(async () => assert.equal(await page.locator('[aria-pressed=true]').filter({ hasText: /^A$/ }).count(), 1))
  await until(async () => assert.equal((await kept()).sessions[0].answers.length, 0))
  await page.keyboard.press('4') // the rating has the keys now
  await page.keyboard.press('Enter')
  await page.keyboard.type('Elbow 1') // the comment has the focus
  await page.keyboard.press('Shift+Enter')
  await page.keyboard.type('? 2')
  await page.keyboard.press('Enter')
  await answered(1)
  const [first] = (await kept()).sessions[0].answers
  assert.deepEqual([first.recorded, first.natural, first.rating, first.comment], ['left', 'right', 4, 'Elbow 1\n? 2'])
  assert.match(first.version, /^signweave \d/)
  // Keys apply to the next trial.
  await seen()
  await page.keyboard.press('2')
  await page.waitForFunction(() => JSON.parse(localStorage.getItem('signweave.study.demo')).sessions[0].draft?.recorded === 'right')
  assert.ok(first.plays >= 1 && first.ms > 0 && Math.abs(Date.parse(first.at) - Date.now()) < 60_000)
  // The others by mouse, with a comment.
  for (let n = 2; n <= 5; ++n) {
    await seen()
    await page
      .locator('.choice')
      .nth(n % 2)
      .click()
    await page
      .locator('.choice')
      .nth(2 + (n % 2))
      .click()
    await button('2').click()
    await page.getByRole('textbox', { name: 'What did you notice' }).fill(n === 3 ? 'He said "no", or\nso' : '')
    for (let i = 0; i < 4 && (await kept()).sessions[0].answers.length < n; ++i) await page.locator('button.next').click()
    await answered(n)
  }
  await page.getByText('You have finished. Thank you!').waitFor()
  await button('Finish').click()

  await forMaker()
  const study = await kept(),
    rows = parsed(await saved('Votes as CSV'))
  assert.equal(rows.length, 10)
  for (const [i, row] of rows.entries()) {
    const { item, side } = study.sessions[0].trials[Math.floor(i / 2)],
      answer = study.sessions[0].answers[Math.floor(i / 2)],
      { method, recording, from } = study.items[item]
    assert.deepEqual(
      [row.study_seed, row.participant, row.fluency, row.recording, Number(row.from_ms), row.method],
      ['5', 'P01', 'deaf', recording, from, method || 'captured'],
    )
    const choice = answer[row.question]
    assert.equal(row.answer, choice === 'left' ? 'A' : 'B')
    assert.equal(row.correct, method ? String(Number(choice === side)) : '')
    assert.equal(row.side_of_capture, method ? (side === 'left' ? 'A' : 'B') : 'both')
    assert.deepEqual([Number(row.rating), Number(row.response_ms), Number(row.plays)], [answer.rating, answer.ms, answer.plays])
    assert.match(row.software_version, /^signweave \d/)
  }
  assert.equal(rows[4].comment, 'He said "no", or\nso')
  assert.deepEqual(JSON.parse(await saved('Study and votes as JSON')), study)
})

test('nothing on the screen, in the address or in the timing of requests reveals which is which', async () => {
  await setUp({ methods: ['hermite'], trials: 8, still: false })
  const calls = []
  let free
  const held = new Promise((resolve) => (free = resolve))
  await page.route(/\/motion\?/, async (route) => {
    const url = new URL(route.request().url())
    calls.push({ regenerate: url.searchParams.get('regenerate'), from: url.searchParams.get('from') })
    // The second response is delayed: the first must not be shown alone.
    if (calls.length === 2) await held
    await route.fallback()
  })
  const first = page.waitForResponse(/\/motion\?/)
  await begin()
  await page.waitForFunction(() => document.querySelector('.over'))
  await until(() => assert.equal(calls.length, 2))
  await (await first).finished()
  await frames(page)
  await until(async () => assert.equal(await page.evaluate(() => window.signweaveStage.panes.length), 0))
  free()
  await seen()
  const {
    items,
    sessions: [{ trials }],
  } = await kept()
  const { side } = trials[0],
    { from, to, begin: start } = items[trials[0].item]
  // In the order of the sides: over a study each order is equally frequent.
  assert.deepEqual(
    calls.slice(0, 2).map(({ regenerate }) => Boolean(regenerate)),
    side === 'left' ? [false, true] : [true, false],
  )
  assert.equal(trials.filter((one) => one.side === 'left').length, 4)
  const said = await page.evaluate(() => document.documentElement.outerHTML + location.href + document.title)
  for (const word of ['hermite', 'regenerate', 'meteo', 'villes', 'capture', 'original', 'Recorded', 'Generated '])
    assert.ok(!said.includes(word), `${word} is revealed`)

  // The two are identical except for the gap, seen through one camera, and synchronized.
  const apart = await page.evaluate(
    ([low, high]) => {
      const { panes } = window.signweaveStage,
        [a, b] = panes
      const far = Array.from({ length: a.store.length }, (_, frame) => {
        let most = 0
        for (const hand of [0, 1])
          for (const axis of [0, 1, 2]) most = Math.max(most, Math.abs(a.store.hand(frame, hand, axis) - b.store.hand(frame, hand, axis)))
        return most
      })
      const inside = (frame) => frame / a.store.rate > low && frame / a.store.rate < high
      return {
        lengths: [a.store.length, b.store.length],
        inside: Math.max(...far.filter((_, i) => inside(i))),
        outside: Math.max(...far.filter((_, i) => !inside(i))),
        cameras: a.cameras[0] === b.cameras[0],
      }
    },
    [(from - start) / 1000 - 0.011, (to - start) / 1000 + 0.011],
  )
  assert.equal(apart.lengths[0], apart.lengths[1])
  assert.ok(apart.inside > 0.005, `generated and captured are ${apart.inside} m apart`)
  assert.ok(apart.outside < 1e-4, `${apart.outside} m apart outside the gap`)
  assert.ok(apart.cameras)
  await until(async () => {
    const { playing, repeat, speed, loop } = await transport(page)
    assert.deepEqual({ playing, repeat, speed, loop }, { playing: true, repeat: true, speed: 1, loop: null })
  })
  await page.keyboard.press('Space')
  await until(async () => assert.equal((await transport(page)).playing, false))
  // No views, no speed, no other character; the signer cannot be rotated.
  await until(async () =>
    assert.equal(
      await page
        .locator('.tools:visible, input[type=range]:visible, select:visible')
        .filter({ hasNot: page.locator('option', { hasText: 'demo' }) })
        .count(),
      0,
    ),
  )
  await page.mouse.move(200, 300)
  await page.mouse.down()
  await page.mouse.move(300, 300)
  await page.mouse.up()
  await until(async () => assert.equal(await page.evaluate(() => window.signweaveStage.panes[0].camera.azimuth), 0))
  // Replay starts again from the begin.
  await page.evaluate(() => (window.signweaveStage.transport.seek(1.2), window.signweaveStage.touch()))
  await page.keyboard.press('r')
  await page.waitForFunction(() => window.signweaveStage.transport.playing && window.signweaveStage.transport.time < 1.1)
  await page.keyboard.press('Space')
  // The next trial is loaded during the current one, and is there at once.
  await until(() => assert.equal(calls.length, 4))
  await page.keyboard.press('2')
  await page.keyboard.press('Enter')
  await page.keyboard.press('3')
  await page.keyboard.press('Enter')
  await page.keyboard.press('Enter') // no comment
  await answered(1)
  await seen()
  await until(() => assert.equal(calls.length, 6))
  assert.deepEqual(
    calls.slice(2, 4).map(({ regenerate }) => Boolean(regenerate)),
    trials[1].side === 'left' ? [false, true] : [true, false],
  )
})

test('viewers take turns, results are shown only on request, and deleting needs confirmation', async () => {
  await setUp({
    methods: ['hermite'],
    trials: 1,
    more: async () => {
      await page.getByLabel('A comment').uncheck()
      await page.getByLabel('A rating').uncheck()
    },
  })
  for (const [n, fluency] of ['Deaf signer', 'Learner'].entries()) {
    await begin(fluency)
    await seen()
    const { sessions } = await kept()
    await button(sessions[n].trials[0].side === 'left' ? 'A' : 'B').click()
    await page.keyboard.press('Enter') // on the answer that was just selected
    await button('Finish').click()
  }
  // The next viewer sees nothing about the comparison, and nothing about others.
  const said = await page.locator('main').innerText()
  for (const word of ['hermite', 'capture', 'P01', 'Votes', 'the results', 'Delete']) assert.ok(!said.includes(word), `${word} is revealed`)
  await forMaker()
  await until(async () => assert.deepEqual(await page.locator('tbody th').allTextContents(), ['P01', 'P02']))
  await until(async () => assert.equal(await page.getByLabel('Your code').inputValue(), 'P03'))
  await page.getByLabel('Your code').fill('P01')
  await until(async () => assert.ok(await button('Begin').isDisabled()))
  await until(async () => assert.equal(await page.locator('#outcome-title').count(), 0))
  await button('Show the results').click()
  await button('Not now').click()
  await closed()
  await until(async () => assert.equal(await page.locator('#outcome-title').count(), 0))
  await button('Show the results').click()
  await button('Show it').click()
  await page.locator('#outcome-title').waitFor()
  const cells = () => page.locator('[aria-labelledby=outcome-title] tbody tr').first().locator('td, th').allTextContents()
  await until(async () => assert.deepEqual((await cells()).slice(1, 5), ['hermite', '2', '100 % (2/2)', '34–100 %']))
  await page.getByLabel('Votes of').selectOption({ label: 'Deaf signer' })
  await until(async () => assert.deepEqual((await cells()).slice(1, 5), ['hermite', '1', '100 % (1/1)', '21–100 %']))
  await button('Delete the study').click()
  await until(async () => assert.match(await page.getByRole('dialog').textContent(), /its 2 votes/))
  await page.keyboard.press('Escape')
  await closed()
  await until(async () => assert.ok(await kept()))
  await button('Delete the study').click()
  await button('Delete').click()
  await button('Set up the study').waitFor()
  await until(async () => assert.equal(await kept(), null))
})

test('shows one motion at a time, opens a saved study, and rejects invalid files', async () => {
  await setUp({ methods: ['hermite'], trials: 2, more: () => page.getByLabel('One at a time').check() })
  await forMaker()
  const json = await saved('Study and votes as JSON')
  await begin()
  await seen(1)
  await until(async () => assert.equal(await page.locator('.title').count(), 0))
  await button('Generated by a computer').click()
  await page.getByText('How natural does it look?').waitFor()
  await button('5').click()
  await button('Next').click()
  await answered(1)
  await until(async () => assert.equal((await kept()).sessions[0].answers[0].recorded, 'right'))
  await forget()
  await page.reload()
  const choose = async (text) => {
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'), button('Open a study').click()])
    await chooser.setFiles({ name: 'study.json', mimeType: 'application/json', buffer: Buffer.from(text) })
  }
  await choose('{"format":"something"}')
  await until(async () => assert.match(await page.getByRole('alert').textContent(), /This is not a study/))
  await choose(json)
  await button('Begin').waitFor()
  await until(async () => assert.deepEqual(await kept(), JSON.parse(json)))
  await forget()
})

test('a study in two tabs keeps the votes of both, and shows changes of the other', async () => {
  await setUp({ methods: ['hermite'], trials: 2, more: () => page.getByLabel('A comment').uncheck() })
  const other = await context.newPage()
  try {
    await other.addInitScript(() => localStorage.setItem('signweave.body', 'drawn'))
    await other.emulateMedia({ reducedMotion: 'reduce' })
    await other.goto(`${address}/#/demo/compare`)
    await other.getByRole('button', { name: 'Begin' }).waitFor()
    await begin()
    await seen()
    // The code that is taken here is not offered there.
    await other.waitForFunction(() => document.querySelector('form input').value === 'P02')
    await other.getByLabel('Learner').check()
    await other.getByRole('button', { name: 'Begin' }).click()
    await other.waitForFunction(() => window.signweaveStage?.panes.length === 2 && window.signweaveStage.panes.every((pane) => pane.seen))
    const votes = async (at, count) => {
      for (const key of ['1', 'Enter', '5', 'Enter']) await at.keyboard.press(key)
      await answered(count)
    }
    await votes(page, 1)
    await votes(other, 2)
    await seen()
    await votes(page, 3)
    await until(async () =>
      assert.deepEqual(
        (await kept()).sessions.map(({ participant, answers }) => [participant, answers.length]),
        [
          ['P01', 2],
          ['P02', 1],
        ],
      ),
    )
    // After deletion in one tab it disappears in the other.
    await button('Finish').click()
    await forMaker()
    await button('Delete the study').click()
    await until(async () => assert.match(await page.getByRole('dialog').textContent(), /its 3 votes/))
    await button('Delete').click()
    await other.getByRole('button', { name: 'Set up the study' }).waitFor()
  } finally {
    await other.close()
  }
})

test('a stored study that cannot be shown stays until it is deleted, and can be saved', async () => {
  const odd = '{"format":"signweave study 1","settings":{}}'
  await visit('#/demo/compare', { size: kSmall })
  await page.evaluate((text) => localStorage.setItem('signweave.study.demo', text), odd)
  await page.reload()
  assert.equal(await saved('Save as it is (JSON)'), odd)
  await until(async () => assert.equal(await button('Set up the study').count(), 0))
  assert.deepEqual(await axeFaults(page), [])
  await button('Delete the study').click()
  await button('Delete').click()
  await button('Set up the study').waitFor()
  await until(async () => assert.equal(await kept(), null))
})

for (const { size, name, set } of kViewports) {
  test(`an accessibility checker finds nothing in a study, ${name}`, async () => {
    const found = []
    const look = async (name) => {
      found.push(...(await axeFaults(page)).map((fault) => `${name}: ${fault}`))
      assert.ok(
        await page.evaluate(
          () => document.scrollingElement.scrollWidth <= innerWidth && document.querySelector('main').scrollWidth <= document.querySelector('main').clientWidth,
        ),
        `${name} is wider than the screen`,
      )
    }
    await set()
    await visit('#/demo/compare', { size })
    await page.emulateMedia({ reducedMotion: 'reduce' })
    await page.waitForFunction(() => document.querySelector('form button.primary')?.disabled === false)
    await page.locator('summary').click()
    await page.locator('input[type=radio][value=true]').check()
    await look('setting up')
    await page.locator('input[type=radio][value=false]').check()
    await page.locator('form button.primary').click()
    await page.locator('input[name=fluency]').first().check()
    await look('before')
    await page.locator('form button.primary').click()
    await seen()
    await look('a trial')
    await page.locator('.leave').click()
    await page.locator('summary').click()
    await look('for whoever runs it')
    await page.locator('.remove').click()
    await look('deleting')
    await page.evaluate(() => (localStorage.removeItem('signweave.theme'), localStorage.removeItem('signweave.language')))
    await forget()
    assert.deepEqual(found, [])
  })
}
