// The evaluation page: by mouse and keyboard, with one method, so that it is fast.
import assert from 'node:assert/strict'
import { execFileSync } from 'node:child_process'
import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { axeFaults } from './page_tools.mjs'
import { kViewports } from './corpus_tools.mjs'
import { context, folder, kDeclared, mainTest, page, test, visit } from './suite.mjs'
import { until } from './waits.mjs'

const kBin = process.env.SIGNWEAVE_BIN ?? new URL('../../../build/release/bin', import.meta.url).pathname
const button = (name) => page.getByRole('button', { name, exact: true })
const result = () => page.waitForSelector('#result-title', { timeout: 120_000 })
/** Returns the file that a button saves. */
async function saved(press) {
  const [download] = await Promise.all([page.waitForEvent('download'), press()])
  const name = download.suggestedFilename(),
    text = readFileSync(await download.path(), 'utf8')
  // Tables begin with the mark by which Excel recognizes UTF-8.
  assert.equal(text.startsWith('\ufeff'), name.endsWith('.csv'))
  return { name, text: text.replace('\ufeff', '') }
}
const rows = (text) =>
  text
    .trimEnd()
    .split('\r\n')
    .map((line) => line.split(','))
/** Returns the methods of a table, from top to bottom. */
const methods = (table) => page.locator(`[aria-labelledby=${table}] tbody th button`).allTextContents()

async function evaluated() {
  await visit('#/demo/evaluate')
  await button('None').click()
  await page.getByLabel('hermite').check()
  await page.getByLabel('Seed for the intervals').fill('7')
  await button('Evaluate').click()
}

mainTest('evaluates a method, continues while other pages are open, and keeps the result', async () => {
  await evaluated()
  await page.getByRole('progressbar', { name: 'Evaluating' }).waitFor()
  await page.evaluate(() => (location.hash = '#/demo'))
  await page.waitForSelector('#recordings-title')
  await page.evaluate(() => (location.hash = '#/demo/evaluate'))
  await result()
  await until(async () => assert.match((await page.locator('[role=status]').allTextContents()).join(), kDeclared))
  const json = await saved(() => button('JSON').click())
  const evaluation = JSON.parse(json.text)
  assert.equal(json.name, 'evaluation_demo.json')
  assert.equal(evaluation.seed, 7)
  const group = (task, name) => evaluation.tasks.find((one) => one.task === task).groups.find((one) => one.group === name)

  // The table matches the JSON, with the best non-bound method marked.
  await until(async () => assert.deepEqual(await methods('by-group'), ['hermite', 'slerp', 'nearest', 'ceiling']))
  const { value, low, high } = group('given', '170 ms').hands.moving.hermite.wrist.over_slerp
  const cell = page.locator('[aria-labelledby=by-group] tbody tr').first().locator('td').nth(1)
  await until(async () => assert.equal((await cell.innerText()).replace(/\s+/g, ' '), `★ best ${value.toFixed(3)} ${low.toFixed(3)}–${high.toFixed(3)}`))

  // Sorted by a column, descending and ascending.
  const sort = page.getByRole('button', { name: 'Sort by 170 ms' })
  await sort.click()
  const figures = Object.entries(group('given', '170 ms').hands.moving)
    .map(([method, { wrist }]) => [method, wrist.over_slerp.value])
    .sort((a, b) => a[1] - b[1])
  await until(async () =>
    assert.deepEqual(
      await methods('by-group'),
      figures.map(([method]) => method),
    ),
  )
  await sort.click()
  await until(async () => assert.deepEqual(await methods('by-group'), figures.map(([method]) => method).reverse()))
  await until(async () => assert.equal(await page.locator('[aria-labelledby=by-group] th[aria-sort=descending]').innerText(), '170 ms ▼'))

  // Another task, hand and measure, by keyboard; the address contains them.
  await button('Token replaced').focus()
  await page.keyboard.press('Enter')
  await page.getByRole('combobox', { name: 'Hand' }).selectOption('left')
  await page.getByRole('combobox', { name: 'Measure' }).selectOption('abs_ln_peak_speed_ratio')
  await page.getByText('Error of the peak speed').first().waitFor()
  await until(async () => assert.match(await page.evaluate(() => location.hash), /task=replaced&hand=left&measure=abs_ln_peak_speed_ratio/))
  const csv = await saved(() => page.locator('.above', { hasText: 'One measure' }).getByRole('button').click())
  assert.equal(csv.name, 'evaluation_demo_replaced_left_abs_ln_peak_speed_ratio.csv')
  const table = rows(csv.text)
  assert.deepEqual(table[0].slice(0, 5), ['task', 'hand', 'measure', 'method', 'same gloss'])
  const hermite = table.find((row) => row[3] === 'hermite'),
    at = table[0].indexOf('other sign')
  assert.equal(Number(hermite[at]), group('replaced', 'other sign').hands.left.hermite.abs_ln_peak_speed_ratio.value)
  assert.deepEqual(hermite.slice(0, 3), ['replaced', 'left', 'abs_ln_peak_speed_ratio'])

  // It outlives the page, and so does the view.
  await page.reload()
  await result()
  await until(async () => assert.equal(await button('Token replaced').getAttribute('aria-pressed'), 'true'))
})

test('draws the content of the tables, and saves the drawings', async () => {
  await page.evaluate(() => (location.hash = '#/demo/evaluate?task=given&measure=wrist&log=0'))
  await page.waitForFunction(() => document.querySelectorAll('.plot svg').length === 2)
  await page.waitForFunction(() => document.querySelector('.plot svg').textContent.includes('Wrist, mm'))
  const lines = page.locator('.plot svg').first(),
    dots = page.locator('.plot svg').nth(1)
  await until(async () => assert.match(await lines.getAttribute('aria-label'), /^Wrist, mm of each method by length of the gap/))
  await until(async () =>
    assert.deepEqual(
      await dots
        .locator('g > text')
        .allTextContents()
        .then((all) => all.map((one) => one.replace('★ ', ''))),
      ['hermite', 'slerp', 'nearest', 'ceiling'],
    ),
  )
  // A greater error is farther to the right, as in the table.
  const places = await dots.locator('g > circle').evaluateAll((all) => all.map((one) => Number(one.getAttribute('cx'))))
  const values = (await page.locator('[aria-labelledby=by-group] tbody td:nth-child(2) > span').allTextContents()).map((text) =>
    Number(/[\d.]+$/.exec(text)[0]),
  )
  const order = (list) => list.map((_, i) => i).sort((a, b) => list[a] - list[b])
  assert.deepEqual(order(places), order(values))
  // Methods selected in the table are highlighted in the drawings.
  const width = () => dots.locator('g', { hasText: 'nearest' }).locator('path').getAttribute('stroke-width')
  await page.mouse.move(5, 400)
  await until(async () => assert.equal(await width(), '2'))
  await page.locator('[aria-labelledby=by-group]').getByRole('button', { name: 'nearest' }).press('Enter')
  await page.locator('[aria-labelledby=by-group]').getByRole('button', { name: 'nearest' }).blur()
  await until(async () => assert.equal(await width(), '4'))
  const svg = await saved(() => page.getByRole('button', { name: 'SVG By length of the gap' }).click())
  assert.match(svg.name, /\.svg$/)
  assert.doesNotMatch(svg.text, /var\(/)
  await until(async () =>
    assert.equal(await page.evaluate((text) => new DOMParser().parseFromString(text, 'image/svg+xml').documentElement.nodeName, svg.text), 'svg'),
  )
  await page.locator('summary', { hasText: 'All plots' }).click()
  await page.waitForFunction(() => document.querySelector('details img')?.naturalWidth > 800)
})

test('can be cancelled, and evaluates again', async () => {
  await evaluated()
  await button('Cancel').click()
  await page.getByText('The evaluation was cancelled.').waitFor()
  await until(async () => assert.equal(await page.getByRole('alert').count(), 0))
  await until(async () => assert.ok(await button('Evaluate').isEnabled()))
})

test('follows its job through a network failure, can be cancelled during it, and survives an invalid answer', async () => {
  const kJobs = /\/api\/jobs\//
  let away = true
  await context.route(kJobs, (route) => (away ? route.abort() : route.fallback()))
  await evaluated()
  const retry = page.getByRole('alert').getByRole('button')
  await retry.waitFor()
  await page.getByRole('progressbar', { name: 'Evaluating' }).waitFor()
  await button('Cancel').click() // the job cannot be cancelled yet
  away = false
  await retry.click()
  await page.getByText('The evaluation was cancelled.').waitFor()
  await until(async () => assert.equal(await page.getByRole('alert').count(), 0))
  await context.unroute(kJobs)

  await context.route(kJobs, (route) => route.fulfill({ json: { job: '1', state: 'done', fraction: 1, result: { tasks: [], spans: [] } } }))
  await button('Evaluate').click()
  await page.getByText('This evaluation cannot be shown').waitFor()
  await button('Close it').press('Enter')
  await context.unroute(kJobs)
  await until(async () => assert.equal(await page.getByRole('alert').count(), 0))
  await until(async () => assert.ok(await button('Evaluate').isEnabled()))
})

test('opens output of the command line, and rejects other files', async () => {
  const made = execFileSync(join(kBin, 'signweave'), ['evaluate', join(folder, 'corpus/meteo.bvh'), '--method', 'gap', '--method', 'kriging', '--json'], {
    stdio: ['ignore', 'pipe', 'ignore'],
    maxBuffer: 1e9,
  })
  const file = join(folder, 'command_line.json')
  writeFileSync(file, made)
  await visit('#/demo/evaluate')
  const choose = async (name) => {
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'), button('Open an evaluation').press('Enter')])
    await chooser.setFiles(name)
  }
  await choose(join(folder, 'corpus/meteo.eaf'))
  await until(async () => assert.match(await page.getByRole('alert').textContent(), /This is not an evaluation/))
  for (const odd of [
    { tasks: [], spans: [], recordings: 0 },
    { ...JSON.parse(made), spans: [null] },
  ]) {
    writeFileSync(join(folder, 'odd.json'), JSON.stringify(odd))
    await choose(join(folder, 'odd.json'))
    await until(async () => assert.match(await page.getByRole('alert').textContent(), /This is not an evaluation/))
  }
  await choose(file)
  await result()
  await until(async () => assert.match(await page.locator('#result-title').textContent(), /command_line\.json/))
  await until(async () => assert.deepEqual(await methods('by-group'), ['kriging', 'gap', 'slerp', 'ceiling']))
  await until(async () => assert.equal(await page.getByText('there is none for a single recording').count(), 1))
  await until(async () => assert.equal(await page.getByRole('alert').count(), 0))
  await until(async () => assert.equal(await page.locator('details img').count(), 0))
})

test('shows by collection which method may be the default', async () => {
  const table = join(folder, 'who.csv')
  writeFileSync(table, 'meteo,weather\nvilles,towns\n')
  writeFileSync(join(folder, 'some.csv'), 'meteo,600,20\nmeteo,700,30\nmeteo,900,30\nvilles,800,20\nvilles,900,20\nvilles,1000,20\n')
  const words = [join(folder, 'corpus/meteo.bvh'), join(folder, 'corpus/villes.bvh'), '--collections', table, '--spans', join(folder, 'some.csv')]
  const made = execFileSync(join(kBin, 'signweave'), ['evaluate', ...words, '--method', 'kriging', '--method', 'hermite', '--json'], {
    stdio: ['ignore', 'pipe', 'ignore'],
    maxBuffer: 1e9,
  })
  const file = join(folder, 'judged.json')
  writeFileSync(file, made)
  const { all, collections, may_be_default: may } = JSON.parse(made).judged[0]
  await visit('#/demo/evaluate')
  const [chooser] = await Promise.all([page.waitForEvent('filechooser'), button('Open an evaluation').press('Enter')])
  await chooser.setFiles(file)
  await result()
  await page.getByRole('heading', { name: 'Wrist error relative to kriging, by collection' }).waitFor()
  const cells = async (of) => (await page.locator(`[aria-labelledby=judged] ${of}`).allInnerTexts()).map((text) => text.replace(/\s+/g, ' ').trim())
  assert.deepEqual(await cells('thead th'), ['Method', 'towns', 'weather', 'All', 'May be the default'])
  const figure = ({ value, low, high }) => `${value.toFixed(3)} ${low.toFixed(2)}–${high.toFixed(2)}`
  assert.equal(may, false)
  assert.deepEqual(await cells('tbody th'), ['hermite'])
  assert.deepEqual(await cells('tbody td'), [...collections.map(figure), figure(all), 'no: worse'])
  const csv = rows((await saved(() => page.locator('.above', { hasText: 'relative to kriging' }).getByRole('button').click())).text)
  assert.deepEqual(csv[0].slice(0, 3), ['method', 'over', 'towns'])
  assert.equal(Number(csv[1][2]), collections[0].value)
  // It exists for the given duration only.
  await button('Duration predicted').click()
  await until(async () => assert.equal(await page.locator('#judged').count(), 0))
})

for (const { size, name, set } of kViewports) {
  test(`an accessibility checker finds nothing in an evaluation, ${name}`, async () => {
    await set()
    await visit('#/demo/evaluate', { size })
    assert.deepEqual(await axeFaults(page), [])
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.locator('.open button').click()])
    await chooser.setFiles(join(folder, 'command_line.json'))
    await result()
    for (const summary of await page.locator('summary').all()) await summary.click()
    assert.deepEqual(await axeFaults(page), [])
    assert.ok(
      await page.evaluate(
        () =>
          document.scrollingElement.scrollHeight <= innerHeight &&
          document.scrollingElement.scrollWidth <= innerWidth &&
          document.querySelector('main').scrollWidth <= document.querySelector('main').clientWidth,
      ),
      'wider than the screen',
    )
    await page.evaluate(() => (localStorage.removeItem('signweave.theme'), localStorage.removeItem('signweave.language')))
  })
}
