// The search: queries, answers as a table and as a grid.
import assert from 'node:assert/strict'
import { axeFaults, computedBy, transport } from './page_tools.mjs'
import { addressOf, answered, asked, button, field, kAll, list, status } from './search_tools.mjs'
import { kViewports } from './corpus_tools.mjs'
import { address, kDeclared, mainTest, page, test, visit } from './suite.mjs'
import { opened, until } from './waits.mjs'

const near = (value, wanted, tolerance = 1e-3) => assert.ok(Math.abs(value - wanted) <= tolerance, `${value} is not ${wanted}`)
/** Waits until the player next to the table shows a loop of the given seconds. */
const looped = (seconds) =>
  page.waitForFunction((wanted) => {
    const { loop } = window.signweaveStage?.transport ?? {}
    return loop && Math.abs(loop.end - loop.begin - wanted) < 0.015 && window.signweaveStage.panes[0]?.seen
  }, seconds)
const active = () => page.evaluate(() => document.querySelector('.line.active .name')?.textContent)
/** Requests completions until the vocabulary is loaded. */
const completions = () =>
  page.waitForFunction(
    () => {
      const area = document.querySelector('textarea')
      area.dispatchEvent(new KeyboardEvent('keydown', { key: ' ', ctrlKey: true, bubbles: true, cancelable: true }))
      return document.querySelector('.field [role=option]')
    },
    null,
    { polling: 100 },
  )

test('completes a query at the caret, by keyboard alone', async () => {
  await visit('#/demo/search', { still: true })
  await field().focus()
  const options = page.getByRole('listbox', { name: 'Query' }).getByRole('option')
  const first = () => options.first()
  await completions()
  await page.keyboard.press('Escape')
  await until(async () => assert.equal(await page.getByRole('listbox').count(), 0))
  await page.keyboard.type('gl')
  await until(async () => assert.equal(await first().locator('code').textContent(), 'gloss'))
  await until(async () => assert.equal(await field().getAttribute('aria-activedescendant'), null))
  await page.keyboard.press('ArrowDown')
  await until(async () =>
    assert.equal(
      await page.evaluate(() => document.getElementById(document.activeElement.getAttribute('aria-activedescendant'))?.querySelector('code').textContent),
      'gloss',
    ),
  )
  await page.keyboard.press('Enter')
  await until(async () => assert.equal(await field().inputValue(), 'gloss = '))
  await page.keyboard.type('van')
  await until(async () => assert.equal((await first().textContent()).replace(/\s+/g, ' ').trim(), 'VANNES 3 tokens'))
  await page.keyboard.press('ArrowDown')
  await page.keyboard.press('Tab')
  await page.keyboard.type(' & ph')
  await page.keyboard.press('ArrowDown')
  await page.keyboard.press('Enter')
  await page.keyboard.press('Control+Space')
  await until(async () => assert.deepEqual(await options.locator('code').allTextContents(), ['preparation', 'stroke', 'retraction', 'hold', 'other']))
  await page.keyboard.press('ArrowDown')
  await page.keyboard.press('Enter')
  await until(async () => assert.equal(await field().inputValue(), 'gloss = "VANNES" & phase = stroke'))
  await page.keyboard.press('Enter')
  await answered(3)
  await until(async () =>
    assert.equal(new URLSearchParams((await page.evaluate(() => location.hash)).split('?')[1]).get('q'), 'gloss = "VANNES" & phase = stroke'),
  )
  await until(async () => assert.match(await page.locator('[role=status]').filter({ hasText: 'LSF' }).textContent(), kDeclared))
  // A tier's labels are requested when needed, and are in the list as soon as they arrive.
  let asked = 0,
    goOn
  const hold = new Promise((resolve) => (goOn = resolve))
  await page.route('**/labels?tier=Phase', async (route) => {
    ++asked
    await hold
    await route.continue()
  })
  await field().fill('')
  await page.keyboard.type('tier("Phase") = ')
  await until(async () => assert.deepEqual(await options.locator('code').allTextContents(), ['"…"', '$X']))
  goOn()
  await options.filter({ hasText: /^Stroke\s+64 tokens/ }).waitFor()
  await page.keyboard.type('r')
  await until(async () => assert.equal(await first().locator('code').textContent(), 'Retraction'))
  await page.keyboard.press('ArrowDown')
  await page.keyboard.press('Enter')
  await until(async () => assert.equal(await field().inputValue(), 'tier("Phase") = "Retraction"'))
  assert.equal(asked, 1)
  await page.unroute('**/labels?tier=Phase')
})

test('marks the faulty part, and offers suggestions', async () => {
  await visit('#/demo/search', { still: true })
  await field().fill('gloss = "VANNES" &')
  await page.keyboard.press('Shift+Enter')
  await page.keyboard.type(' phase = strok')
  await page.keyboard.press('Escape')
  await page.keyboard.press('Enter')
  await page.waitForFunction(() => document.querySelector('.marked')?.textContent === 'strok')
  await until(async () => assert.match(await page.getByRole('alert').textContent(), /Line 2, column 10: no phase is called 'strok'/))
  await until(async () => assert.equal(await field().getAttribute('aria-invalid'), 'true'))
  const { lines, left } = await page.evaluate(() => {
    const mark = document.querySelector('.marked').getBoundingClientRect(),
      area = document.querySelector('textarea').getBoundingClientRect()
    return { lines: Math.floor((mark.top + mark.height / 2 - area.top - 10) / 21), left: mark.left - area.left }
  })
  assert.equal(lines, 1, 'the mark is not in the second line')
  assert.ok(left > 85 && left < 105, `the mark is at ${left}`)
  await page.keyboard.type('e') // the mark disappears when the text is changed
  await until(async () => assert.equal(await page.locator('.marked').count(), 0))
  await field().fill('glos = "VANNES"')
  await page.keyboard.press('Enter')
  await page.waitForFunction(() => document.querySelector('.marked')?.textContent === 'glos')
  await button('gloss').click()
  await answered(3)
  await until(async () => assert.equal(await field().inputValue(), 'gloss = "VANNES"'))
})

test('finds words, and says how they match', async () => {
  await asked('vannes')
  await answered(3)
  await until(async () => assert.equal(await page.getByRole('gridcell', { name: 'different spelling' }).count(), 3))
  await asked('matin nuages')
  await answered(1)
  await page.getByRole('gridcell', { name: 'in sequence' }).waitFor()
  await asked('vanes')
  await until(async () => assert.match(await status().textContent(), /^No answers/))
  await button('VANNES').click()
  await answered(3)
  await page.getByRole('gridcell', { name: 'this gloss' }).first().waitFor()
  await until(async () => assert.equal(await field().inputValue(), '"VANNES"'))
  // Completion offers glosses before any operator is typed.
  await field().fill('')
  await page.keyboard.type('nua')
  await until(async () => assert.match(await page.locator('#query-options').textContent(), /NUAGES/))
  await page.keyboard.press('Escape')
})

test('gives hints about the database’s content if nothing was found', async () => {
  await asked('gloss = VANES & phase = stroke')
  await until(async () => assert.match(await status().textContent(), /^No answers/))
  await button('VANNES').click()
  await answered(3)
  await until(async () => assert.equal(await field().inputValue(), 'gloss = "VANNES" & phase = stroke'))
  await page.goBack()
  await page.waitForFunction(() => /^No answers/.test(document.querySelector('[data-status=answered]')?.textContent.trim()))
  await until(async () => assert.equal(await field().inputValue(), 'gloss = VANES & phase = stroke'))
})

test('has examples that all find something, and explains the language', async () => {
  await visit('#/demo/search', { still: true })
  const texts = await until(async () => {
    const all = await page.locator('section:has(#examples-title) code').allTextContents()
    assert.ok(all.length > 8, `${all}`)
    return all
  })
  for (const text of texts) {
    const found = await (
      await fetch(`${address}/api/databases/demo/query`, {
        method: 'POST',
        headers: { 'Content-Type': 'application/json' },
        body: JSON.stringify({ text, limit: 5 }),
      })
    ).json()
    assert.ok(found.length > 0, text)
  }
  await button('Query language').click()
  await until(async () => assert.ok((await page.locator('section:has(#language-title) dt').count()) > 25))
  await button('What to search for').click()
  await button('A word: signs of that gloss', {}).click()
  await answered(3)
  await page.getByRole('gridcell', { name: 'different spelling' }).first().waitFor()
})

mainTest('plays a row as a loop, moves from row to row, and opens the recording there', async () => {
  await asked(kAll, 64, { still: false })
  await looped(1.78)
  await until(async () => assert.equal((await transport(page)).playing, true))
  await list().focus()
  await page.keyboard.press('ArrowDown')
  await looped(1.37)
  await until(async () => assert.equal(await active(), 'METEO'))
  await page.keyboard.press('Space')
  await until(async () => assert.equal((await transport(page)).playing, false))
  await page.keyboard.press('2')
  await until(async () => assert.equal(await button('Left side').getAttribute('aria-pressed'), 'true'))
  await page.getByLabel('Include context').check()
  await looped(1.77)
  await list().focus()
  await page.keyboard.press('End')
  await until(async () => assert.equal(await active(), 'LE MANS'))
  await page.keyboard.press('Home')
  await page.keyboard.press('ArrowDown')
  await page.keyboard.press('x')
  await page.keyboard.press('Enter')
  await opened(page, '#/demo/recording/meteo')
  await until(async () => {
    const { loop, time } = await transport(page)
    for (const [value, wanted] of [
      [loop.begin, 2.98],
      [loop.end, 4.35],
      [time, 2.98],
    ])
      near(value, wanted)
  })
  await page.waitForFunction(() => document.querySelector('.selection')?.getBoundingClientRect().width > 20)
  await page.goBack() // to the same row, selection and focus as before
  await page.waitForFunction(() => document.querySelector('.line.active .name')?.textContent === 'METEO' && document.activeElement?.matches('.rows'))
  await page.getByText('1 selected', { exact: true }).waitFor()
  await until(async () => assert.deepEqual(await page.locator('.shown .line:has(input:checked) .name').allTextContents(), ['METEO']))
})

test('sorts and filters answers', async () => {
  await asked(kAll, 64)
  const names = () => page.locator('.shown .name').allTextContents()
  await button('Duration').click()
  await button('Duration').click()
  const durations = await page
    .locator('.shown .line > :last-child')
    .evaluateAll((cells) => cells.map(({ textContent }) => Number(textContent.replace(/\D/g, ''))))
  assert.deepEqual(
    durations,
    durations.toSorted((a, b) => b - a),
  )
  await until(async () => assert.equal(await page.getByRole('columnheader', { name: 'Duration' }).getAttribute('aria-sort'), 'descending'))
  await button('Name').click()
  await until(async () => assert.deepEqual((await names()).slice(0, 2), ['APRES-MIDI', 'ATTENTION']))
  await page.getByRole('searchbox').fill('vil nan')
  await page.waitForFunction(() => document.querySelectorAll('.shown .line').length < 5)
  await until(async () => assert.deepEqual([...new Set(await names())], ['NANTES']))
  await until(async () => assert.match(await status().textContent(), /64 answers in .*, 2 shown/))
})

/** Returns the cost of the sheet's frames over some seconds. */
const drawn = (seconds = 2) =>
  page.evaluate(async (ms) => {
    const sheet = window.signweaveSheet
    sheet.costs.fill(0)
    const from = sheet.pictures,
      start = performance.now()
    await new Promise((resolve) => setTimeout(resolve, ms))
    const costs = [...sheet.costs].filter((cost) => cost > 0).sort((a, b) => a - b)
    return { rate: (1000 * (sheet.pictures - from)) / (performance.now() - start), median: costs[costs.length >> 1] ?? 0 }
  }, 1000 * seconds)
/** Waits until at least this many small players are visible and drawn. */
const seen = (least) =>
  page
    .waitForFunction((n) => {
      const cells = [...(window.signweaveSheet?.cells.values() ?? [])].filter(({ y, height }) => y + height > 0 && y < window.signweaveSheet.height)
      return cells.length >= n && cells.every((cell) => cell.seen) && cells.length
    }, least)
    .then((found) => found.jsonValue())
const cells = () =>
  page.evaluate(() =>
    [...window.signweaveSheet.cells.entries()].map(([key, { time, motion, y, height }]) => ({ key, time, length: motion.store.seconds, y, height })),
  )
const held = () => page.evaluate(() => ({ ...window.signweaveSheet.held, cells: window.signweaveSheet.cells.size, actors: window.signweaveSheet.actorCount }))

test('shows many tokens as a grid, synchronized and individually', async () => {
  await asked(kAll, 64, { more: '&view=grid', still: false })
  const medium = await seen(12),
    first = await drawn()
  await page.getByLabel('Size').selectOption('small')
  const small = await seen(24),
    then = await drawn()
  console.log(
    `side by side: ${medium} seen ${first.rate.toFixed(1)} pictures a second (main thread ${first.median.toFixed(1)} ms), ` +
      `${small} seen ${then.rate.toFixed(1)} (${then.median.toFixed(1)} ms)`,
  )
  await page.getByRole('combobox', { name: 'Timing' }).selectOption('step')
  /** Returns how far apart the cells are in their loops; those that never moved count as the middle. */
  const apart = (least, most) =>
    page.waitForFunction(
      ([from, to]) => {
        const parts = [...window.signweaveSheet.cells.values()].map(({ time, motion }) => time / motion.store.seconds)
        const width = Math.max(...parts) - Math.min(...parts)
        return parts.length > 20 && parts[0] > 0 && Math.abs(parts[0] - 0.5) > 1e-4 && width >= from && width <= to
      },
      [least, most],
    )
  await apart(0, 1e-6)
  await page.getByRole('combobox', { name: 'Timing' }).selectOption('own')
  await apart(0.05, 1)
  await page.getByLabel('View').selectOption('hands')
  await until(async () =>
    assert.equal(await page.evaluate(() => [...window.signweaveSheet.cells.values()].every(({ camera }) => camera.view === 'hands')), true),
  )
  await list().focus()
  await page.keyboard.press('Space')
  const still = await cells()
  await page.getByRole('gridcell').nth(2).hover()
  await page.waitForFunction((before) => [...window.signweaveSheet.cells.values()].some(({ time }, i) => time !== before[i].time), still)
  const moving = (await cells()).filter(({ time }, i) => time !== still[i].time)
  assert.deepEqual(
    moving.map(({ key }) => key.split(' ')[0]),
    ['2'],
    'another one than the one pointed at plays',
  )
  await page.keyboard.press('ArrowRight')
  await page.keyboard.press('ArrowDown')
  await until(async () =>
    assert.match(
      await page.evaluate(() => document.getElementById(document.activeElement.getAttribute('aria-activedescendant')).querySelector('strong').textContent),
      /^[A-Z]/,
    ),
  )
  await page.keyboard.press('Home')
  await page.keyboard.press('ArrowRight')
  await page.keyboard.press('Enter')
  await opened(page, '#/demo/recording/meteo')
  near((await transport(page)).loop.begin, 2.98)
})

test('scrolls through hundreds of small players without using more memory', async () => {
  await asked('phase =~ /.*/', 192, { more: '&view=grid' })
  await seen(12)
  const before = await held()
  await list().focus()
  for (let i = 0; i < 6; ++i) await page.keyboard.press('PageDown')
  await seen(6)
  await page.keyboard.press('End')
  await seen(6)
  await until(async () => assert.match(await page.evaluate(() => document.querySelector('.cell.active strong').textContent), /retraction|stroke|preparation/))
  const after = await held()
  assert.ok(after.cells <= before.cells + 12 && after.actors <= 2, JSON.stringify({ before, after }))
  assert.ok(after.geometries <= 2 * before.geometries + 4 && after.textures <= 2 * before.textures + 4, JSON.stringify({ before, after }))
  await until(async () => assert.equal((await page.getByText('No face captured').count()) > 0, true)) // villes has none
  await until(async () => assert.equal(await page.evaluate(() => document.querySelectorAll('canvas').length), 1))
  await button('Table').click()
  await page.waitForFunction(() => window.signweaveSheet === undefined && window.signweaveStage?.panes[0]?.seen)
})

test('scrolls through a hundred thousand answers smoothly', async () => {
  await asked('phase =~ /.*/ ->[0ms..] phase =~ /.*/ ->[0ms..] phase =~ /.*/', 100000)
  await page.waitForFunction(() => window.signweaveStage?.panes[0]?.seen)
  // The page's own computation per frame, excluding waits for a processor.
  const computed = await computedBy(page)
  const costs = []
  let rows = 0
  for (let from = 0; from < 180; from += 10) {
    const before = await computed()
    const most = await page.evaluate(async (first) => {
      const view = document.querySelector('.rows')
      const far = view.scrollHeight - view.clientHeight
      let seen = 0
      for (let i = first; i < first + 10; ++i) {
        // First like a wheel, then like dragging the scroll bar.
        if (i < 120) view.scrollTop += 120
        else view.scrollTop = (far * (i - 119)) / 60
        await new Promise(requestAnimationFrame)
        seen = Math.max(seen, view.querySelectorAll('[role=row]').length)
      }
      return seen
    }, from)
    costs.push(((await computed()) - before) / 10)
    rows = Math.max(rows, most)
  }
  const last = await page.evaluate(() => document.querySelector('.rows .shown .line:last-child').getAttribute('aria-rowindex'))
  const [median, most] = [costs.toSorted((a, b) => a - b)[costs.length >> 1], Math.max(...costs)]
  console.log(`100 000 rows scrolled: ${median.toFixed(1)} ms computed per frame (median of ten; maximum ${most.toFixed(1)}), at most ${rows} rows in the page`)
  assert.ok(rows < 60, `${rows} rows`)
  assert.equal(last, '100001')
  assert.ok(median < 50 && most < 150, `it does not scroll smoothly: ${costs}`)
  await list().focus()
  await page.keyboard.press('Home')
  await page.keyboard.press('PageDown')
  const place = await page.evaluate(
    () => document.querySelector('.line.active').getBoundingClientRect().top - document.querySelector('.rows').getBoundingClientRect().top,
  )
  assert.ok(place > 0 && place < 600)
  const sorting = await page.evaluate(async () => {
    const start = performance.now()
    ;[...document.querySelectorAll('[role=columnheader] button')].find(({ textContent }) => textContent.startsWith('Name')).click()
    await new Promise(requestAnimationFrame)
    return performance.now() - start
  })
  console.log(`100 000 rows sorted by name: ${Math.round(sorting)} ms`)
  // No address can hold this many: it is reported, and none is created.
  await button('Select all').click()
  await page.getByText('At most 200 can be signed at a time: select fewer.').waitFor()
  await until(async () => assert.equal(await button('Sign these').isDisabled(), true))
  await until(async () => assert.ok(await page.evaluate(() => [...document.querySelectorAll('a')].every(({ href }) => href.length < 10_000))))
})

test('shows every column in full next to the player', async () => {
  for (const query of ['like("villes"@1200..3010)', 'gloss = $X ->[0ms..] gloss = $Y']) {
    await asked(query)
    const { wide, cut } = await page.evaluate(() => {
      const view = document.querySelector('.rows'),
        cells = [...view.querySelectorAll('[role=columnheader], .sort, .cell.right')]
      return {
        wide: view.scrollWidth - view.clientWidth,
        cut: cells.filter((cell) => cell.scrollWidth > cell.clientWidth).map(({ textContent }) => textContent),
      }
    })
    assert.deepEqual({ wide, cut }, { wide: 0, cut: [] }, query)
  }
})

test('finds movements similar to a span selected on the timeline', async () => {
  await visit('#/demo/recording/villes', { still: true })
  const lane = await page.getByRole('slider', { name: 'Time' }).boundingBox(),
    { duration } = await transport(page)
  await page.mouse.click(lane.x + (2 / duration) * lane.width, lane.y + 36)
  await page.getByRole('link', { name: 'Find similar movements' }).click()
  await answered()
  await until(async () => assert.equal(await field().inputValue(), 'like("villes"@1200..3010)'))
  const distances = (await page.locator('.shown .line > :nth-child(2)').allTextContents()).map(Number)
  assert.ok(distances.length > 10 && distances[0] === 0)
  assert.deepEqual(
    distances,
    distances.toSorted((a, b) => a - b),
  )
  await until(async () => assert.match(await page.locator('.line.active').textContent(), /villes.*VANNES/))
  await page.getByLabel('Nearest').selectOption('20')
  await answered(20)
  await button('Grid').click()
  await page.waitForFunction(() => /^0\.000/.test(document.querySelector('.cell .number')?.textContent.trim()))
})

test('reports a refusal by the server, and keeps the previous answers', async () => {
  await asked(kAll, 64)
  await page.route(/\/query$/, (route) => route.abort())
  await field().fill('gloss = "VANNES"')
  await page.keyboard.press('Enter')
  await page.getByText('The server does not answer').waitFor()
  await until(async () => assert.equal((await page.locator('.shown .line').count()) > 10, true))
  await until(async () => assert.equal(await field().inputValue(), 'gloss = "VANNES"'))
  await page.unroute(/\/query$/)
  await button('Try again').click()
  await answered(3)
})

for (const { size, name, set } of kViewports) {
  test(`an accessibility checker finds nothing in the search, ${name}`, async () => {
    await set()
    const found = []
    for (const hash of [
      '#/demo/search',
      addressOf('gloss = "VANNES" | gloss = "METEO"'),
      addressOf('like("villes"@1200..3010)', '&view=grid'),
      addressOf('glos = "X"'),
      addressOf('gloss = VANES'),
    ]) {
      await visit(hash, { size, still: true })
      await page.waitForFunction(() => document.querySelector('#examples-title, [data-status=answered], .marked'))
      if (/VANNES/.test(hash)) await page.locator('summary').click()
      found.push(...(await axeFaults(page)).map((fault) => `${hash}: ${fault}`))
      assert.ok(
        await page.evaluate(() => document.scrollingElement.scrollWidth <= innerWidth && document.querySelector('main').scrollWidth <= innerWidth),
        `${hash} is wider than the screen`,
      )
      if (hash === '#/demo/search') {
        await field().fill('gloss = ')
        await completions()
        await page.keyboard.press('Escape')
        await page.locator('.does button').last().click()
        found.push(...(await axeFaults(page)).map((fault) => `language: ${fault}`))
      }
    }
    await page.evaluate(() => (localStorage.removeItem('signweave.theme'), localStorage.removeItem('signweave.language')))
    assert.deepEqual(found, [])
  })
}
