// Import, recordings and phases, as a person would use them.
import assert from 'node:assert/strict'
import { execFileSync } from 'node:child_process'
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs'
import { dirname, join, resolve } from 'node:path'
import { fileURLToPath } from 'node:url'
import { axeFaults, transport } from './page_tools.mjs'
import { withServer } from './server.mjs'
import { address, context, folder, page, test, visit } from './suite.mjs'

const kRoot = resolve(dirname(fileURLToPath(import.meta.url)), '../../..')
const kSignweave = join(process.env.SIGNWEAVE_BIN ?? join(kRoot, 'build/release/bin'), 'signweave')
const kThanks = join(kRoot, '../shared/data/bvh/signon-thanks')
const button = (name) => page.getByRole('button', { name, exact: true })
const stored = async (database = 'mine') => (await (await fetch(`${address}/api/databases/${database}`)).json()).recordings
const storedOne = async (name) => (await fetch(`${address}/api/databases/mine/recordings/${encodeURIComponent(name)}`)).json()
const annotation = async (name) => (await fetch(`${address}/api/databases/mine/recordings/${encodeURIComponent(name)}/annotation`)).text()

/** Files of a recording of the demo's first seconds, under another name; `change` may change the texts. */
function files(name, { seconds = 8, into = join(folder, 'files'), motion = true, change = (text) => text } = {}) {
  mkdirSync(into, { recursive: true })
  const corpus = join(folder, 'corpus')
  const [head, rest] = readFileSync(join(corpus, 'meteo.bvh'), 'utf8').split(/^(?=Frames:)/m)
  const lines = rest.split('\n')
  const bvh = `${head}Frames: ${seconds * 100}\n${lines[1]}\n${lines.slice(2, 2 + seconds * 100).join('\n')}\n`
  const eaf = readFileSync(join(corpus, 'meteo.eaf'), 'utf8').replaceAll('meteo.bvh', `${name}.bvh`)
  if (motion) writeFileSync(join(into, `${name}.bvh`), change(bvh))
  writeFileSync(join(into, `${name}.eaf`), change(eaf))
  return [...(motion ? [join(into, `${name}.bvh`)] : []), join(into, `${name}.eaf`)]
}
const choose = (list) => page.locator('input[type=file]:not([webkitdirectory])').setInputFiles(list)
/** Drops files on the page, made there, as no test can drag from a desktop. */
const drop = (list) => page.evaluate((all) => {
  const transfer = new DataTransfer()
  for (const [name, text] of all) transfer.items.add(new File([text], name))
  document.querySelector('main').dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }))
}, list)
const names = () => page.locator('.list .line:not(.head) > :nth-child(1)').allTextContents()
const look = async () => {
  await page.getByRole('button', { name: /^(Send and look|Send the rest|Look again)$/ }).click()
  await page.getByRole('heading', { name: 'What would be stored' }).waitFor({ timeout: 60_000 })
}
const row = (name) => page.getByRole('row', { name: new RegExp(`Import ${name} `) })
/** Until reports are as they were corrected. */
const settled = () => page.waitForFunction(() => !/looking again/.test(document.querySelector('main').textContent) && !document.querySelector('.acts progress'))
const begin = async () => {
  await visit('#/mine/import')
  await page.locator('.drop').waitFor()
  page.on('dialog', (dialog) => dialog.accept())
}

test('takes files that are dropped and folders, and says at once what cannot be sent', async () => {
  await begin()
  const walk = ['walk.bvh', 'HIERARCHY\nROOT']
  await drop([walk, ['film.mp4', 'x'], ['notes.txt', 'x'], ['a:b.bvh', 'x'], ['.hidden.bvh', 'x']])
  await page.getByText('Files that cannot be sent: 4.').waitFor()
  assert.match(await page.locator('main').textContent(), /the server reads \.bvh .*\.eaf/)
  assert.match(await page.locator('main').textContent(), /films are not stored/)
  await button('Remove them').click()
  assert.deepEqual(await names(), ['walk.bvh'])
  // By keyboard, too.
  await page.getByRole('grid', { name: 'Files' }).focus()
  await page.keyboard.press('Delete')
  assert.deepEqual(await names(), [])
  const days = join(folder, 'days')
  for (const day of ['one', 'two']) files('same', { into: join(days, day), seconds: 1 })
  writeFileSync(join(days, '.DS_Store'), 'x')
  await page.locator('input[webkitdirectory]').setInputFiles(days)
  await page.getByText('Files of the same name lie in several folders').waitFor()
  await button('Put their folders’ names in front').click()
  assert.deepEqual((await names()).map((name) => name.replace(/.*\//, '')), ['days_one_same.bvh', 'days_one_same.eaf', 'days_two_same.bvh', 'days_two_same.eaf'])
})

test('sends with a progress in bytes, and again only what failed', async () => {
  await begin()
  await choose([...files('first'), ...files('second')])
  const put = []
  let broken = true
  await page.route(/\/files\//, (route) => {
    const name = decodeURIComponent(route.request().url().split('/').at(-1))
    put.push(name)
    return name === 'second.bvh' && broken ? route.abort() : route.continue()
  })
  await button('Send and look').click()
  await button('Send the rest').waitFor()
  assert.match(await page.locator('.list').textContent(), /not sent: The server does not answer/)
  assert.deepEqual(put.toSorted(), ['first.bvh', 'first.eaf', 'second.bvh', 'second.eaf'])
  broken = false
  put.length = 0
  // Over a slow line one sees how many bytes have gone, within a file, too; cancelled, it is still to be sent.
  const line = await context.newCDPSession(page)
  const speed = (uploadThroughput) => line.send('Network.emulateNetworkConditions', { offline: false, latency: 0, downloadThroughput: -1, uploadThroughput })
  await speed(200_000)
  await button('Send the rest').click()
  await page.waitForFunction(() => /second\.bvh\s*motion\s*927 kB\s*[1-9]\d? %/.test(document.querySelector('.list').textContent) && /Sending: 1\.\d MB of 1\.9 MB/.test(document.querySelector('.acts').textContent))
  await button('Cancel').click()
  await button('Send the rest').waitFor()
  await speed(-1)
  await look()
  assert.deepEqual(put, ['second.bvh', 'second.bvh'])
  assert.deepEqual(await page.locator('.report .name').allTextContents(), ['first', 'second'])
  assert.equal((await stored()).length, 0)
})

test('reports what was guessed, and stores what was corrected', async () => {
  await begin()
  const turned = (text) => text.replaceAll('Gloss"', 'Words"').replaceAll('Phase"', 'Parts"')
  writeFileSync(join(folder, 'broken.bvh'), 'HIERARCHY\nROOT')
  await choose([...files('plain'), ...files('other', { change: turned }), join(folder, 'broken.bvh')])
  await look()
  assert.match(await row('plain').textContent(), /plain\s*new\s*8\.0 s/)
  assert.match(await row('broken').textContent(), /cannot be read/)
  await row('broken').click()
  assert.match(await page.locator('article').textContent(), /broken\.bvh:2: expected '\{'/)
  await row('plain').click()
  const article = page.locator('article')
  for (const fact of [/Frames\s*800/, /Frames a second\s*100/, /Vertical axis\s*Y/, /Unit, m\s*0\.01/, /Mirrored\s*no/, /sign tier 'Gloss' guessed/, /frozen joint · 3 frames 171 to 287, RightHandRing3/, /Names as MotionBuilder has them/, /synthetic motion: placeholder shapes/]) {
    assert.match(await article.textContent(), fact)
  }
  // One recording: who signs, what a tier is, which joint is what; all: the unit.
  await page.locator('#one-signer').fill('Zoé')
  await page.getByLabel('Joint: left wrist').fill('LeftForeArm')
  await page.keyboard.press('Tab')
  await settled()
  assert.match(await article.textContent(), /LeftForeArm.*(two parts|already|before)|forearm/i)
  assert.equal(await page.getByLabel('Joint: left wrist').inputValue(), 'LeftForeArm', 'what was typed is lost by a fault')
  await button('As the server tells it').click()
  await page.getByLabel('Joint: jaw').fill('')
  await page.keyboard.press('Tab')
  await row('other').click()
  await page.getByLabel('Taken as: Words').selectOption('signs')
  await page.getByLabel('Hand: Words').selectOption('right')
  await settled()
  await page.getByText('Corrections for all recordings').click()
  await page.locator('#all-unit').fill('0.02')
  await page.keyboard.press('Tab')
  await settled()
  assert.match(await article.textContent(), /Unit, m\s*0\.02/)
  assert.match(await article.textContent(), /Signs\s*36/)
  await page.getByRole('button', { name: /^Import 2$/ }).click()
  await page.getByText('Stored: 2').waitFor({ timeout: 60_000 })
  assert.deepEqual((await stored()).map(({ name, signer }) => [name, signer]), [['other', 'synthetic'], ['plain', 'Zoé']])
  const plain = await storedOne('plain')
  assert.equal(plain.rig.parts.jaw, undefined)
  assert.ok(plain.defects.some(({ kind }) => kind === 'scale'), 'it is not twice as tall')
  await row('other').click()
  await page.getByRole('link', { name: 'Open' }).click()
  await page.waitForFunction(() => /recording\/other/.test(location.hash))
  // The import is still there for whoever comes back.
  await page.goBack()
  await page.getByText('Stored: 2').waitFor()
})

test('takes a table of pairs and a mapping file, as a person wrote them', async () => {
  await begin()
  await choose([...files('day1', { seconds: 2 }), ...files('notes', { motion: false })])
  await drop([['pairs.csv', 'motion,annotation,signer\nfar/day1.bvh,eaf\\notes.eaf,Ada\ngone.bvh,\n'], ['map.rig', '# none\njaw =\n']])
  await page.getByText('Table of pairs, line 3: “gone.bvh” was not chosen.').waitFor()
  await look()
  await row('day1').click()
  await settled()
  assert.deepEqual(await page.locator('.report .name').allTextContents(), ['day1'])
  assert.equal(await page.getByLabel('Annotation', { exact: true }).inputValue(), 'notes.eaf')
  await page.getByText('In no recording, and not stored: day1.eaf').waitFor()
  await page.getByRole('button', { name: /^Import 1$/ }).click()
  await page.getByText('Stored: 1').waitFor({ timeout: 60_000 })
  const one = await storedOne('day1')
  assert.deepEqual([one.signer, one.annotation_file, one.rig.parts.jaw], ['Ada', 'notes.eaf', undefined])
})

test('says what becomes of a recording that is known, and pairs files as it is told', async () => {
  await begin()
  const other = (text) => text.replace('>BONJOUR<', '>SALUT<')
  await choose([...files('plain', { change: other }), ...files('alone', { motion: false })])
  await look()
  await row('plain').click()
  await page.getByText('The database has a recording of this name').waitFor()
  await row('alone').click()
  assert.match(await page.locator('article').textContent(), /it can be searched, not signed/)
  // The motion gets the annotation of another name, and is split from it again; what no recording has is told.
  await page.getByLabel('Motion', { exact: true }).selectOption('plain.bvh')
  await settled()
  assert.deepEqual(await page.locator('.report .name').allTextContents(), ['plain'])
  assert.equal(await page.getByLabel('Annotation', { exact: true }).inputValue(), 'alone.eaf')
  await page.getByText('In no recording, and not stored: plain.eaf').waitFor()
  await button('Split into two recordings').click()
  await settled()
  await row('plain').click()
  await page.getByLabel('Annotation', { exact: true }).selectOption('plain.eaf')
  await settled()
  assert.deepEqual(await page.locator('.report .name').allTextContents(), ['alone', 'plain'])
  await row('alone').getByRole('checkbox').uncheck()
  // Read with another unit than it was, it is another motion: that is taken only when told so.
  await row('plain').click()
  await page.locator('#one-unit').fill('0.03')
  await page.keyboard.press('Tab')
  await settled()
  await page.getByRole('button', { name: /^Import 1$/ }).click()
  await page.getByText('Not stored: 1').waitFor({ timeout: 60_000 })
  assert.match(await page.locator('article').textContent(), /is not the motion that recording 'plain' was imported from/)
  await page.locator('article').getByLabel('Replace motion and face that are stored').check()
  await settled()
  await page.getByText('annotation, motion and face are replaced by these files').waitFor()
  await page.getByRole('button', { name: /^Import 1$/ }).click()
  await page.getByText('Stored: 1').waitFor({ timeout: 60_000 })
  assert.match(await row('plain').textContent(), /motion replaced/)
  assert.match(await annotation('plain'), />SALUT</)
  assert.equal((await stored()).length, 3)
})

test('takes recordings of signs, with a mend that the server names', async () => {
  if (!existsSync(kThanks)) return console.log('not run: no shared data (bvh/signon-thanks)')
  await begin()
  await choose(readdirSync(kThanks).map((name) => join(kThanks, name)))
  await look()
  assert.deepEqual(await page.locator('.report .name').allTextContents(), ['ISL Thanks', 'NGT Thanks', 'VGT Thanks'])
  await page.locator('article').getByRole('button', { name: 'Mend all 3 that have it' }).click()
  await settled()
  assert.doesNotMatch(await page.locator('article').textContent(), /permuted/)
  await page.getByRole('button', { name: /^Import 3$/ }).click()
  await page.getByText('Stored: 3').waitFor({ timeout: 60_000 })
  assert.ok((await storedOne('ISL Thanks')).defects.every(({ kind }) => kind !== 'permuted root'))
})

test('stores nothing where it may only read', async () => {
  await withServer(process.env.SITE, async (at) => {
    const reader = await context.newPage()
    try {
      await reader.goto(`${at}/#/demo/import`)
      await reader.getByText('demo is served for reading only').waitFor()
      assert.equal(await reader.locator('input[type=file]').count(), 0)
      await reader.goto(`${at}/#/demo`)
      await reader.getByRole('button', { name: /Details of meteo/ }).click()
      await reader.getByRole('link', { name: 'Phases' }).waitFor()
      assert.equal(await reader.getByRole('button', { name: /Remove|Change storage/ }).count(), 0)
      assert.equal(await reader.getByRole('link', { name: 'Import' }).count(), 0)
    } finally {
      await reader.close()
    }
  })
})

test('finds recordings, sorts them, and opens the player where something is wrong', async () => {
  await visit('#/mine')
  const shown = () => page.locator('tbody th a').allTextContents()
  await page.getByRole('searchbox').fill('O')
  assert.ok((await shown()).includes('other') && !(await shown()).includes('plain'))
  await page.getByRole('searchbox').fill('')
  await page.getByLabel('Signer', { exact: true }).selectOption('Zoé')
  assert.deepEqual(await shown(), ['plain'])
  await page.getByLabel('Signer', { exact: true }).selectOption('*')
  await page.getByRole('button', { name: 'Name', exact: false }).first().focus()
  await page.keyboard.press('Enter')
  assert.deepEqual(await shown(), (await stored()).map(({ name }) => name).toSorted((a, b) => b.localeCompare(a)))
  assert.equal(await page.locator('th[aria-sort=descending]').count(), 1)
  await page.getByRole('button', { name: 'Details of plain' }).click()
  await page.getByRole('link', { name: 'frames 333 to 521' }).click()
  await page.waitForFunction(() => window.signweaveStage?.panes[0]?.seen && Math.abs(window.signweaveStage.transport.time - 3.33) < 1e-6)
})

test('changes how recordings are stored, and removes only what is confirmed', async () => {
  await visit('#/mine')
  await page.getByLabel('Choose plain').check()
  await button('Change storage').click()
  assert.ok(await page.getByLabel('Those that are chosen: 1').isChecked())
  await page.getByLabel('How motion is cut').selectOption('by_joint_and_frame')
  await page.getByLabel('Frames in a piece').fill('many')
  assert.ok(await button('Change').isDisabled())
  await page.getByLabel('Frames in a piece').fill('50')
  await button('Change').click()
  await page.getByText('Stored anew: 1 of 1').waitFor({ timeout: 60_000 })
  await button('Close').click()
  await page.locator('tr', { hasText: 'plain' }).getByText('by_joint_and_frame:50').waitFor()
  assert.deepEqual((await stored()).filter(({ access_mode: mode }) => mode === 'by_joint_and_frame:50').map(({ name }) => name), ['plain'])
  await page.getByRole('button', { name: 'Details of other' }).click()
  const before = (await stored()).length
  for (const [answer, after] of [['Cancel', before], ['Remove', before - 1]]) {
    await page.getByRole('button', { name: 'Remove other' }).click()
    assert.match(await page.getByRole('dialog').textContent(), /Remove from mine\?\s*other/)
    await page.getByRole('dialog').getByRole('button', { name: answer }).click()
    await page.waitForFunction(() => !document.querySelector('dialog'))
    assert.equal((await stored()).length, after)
  }
  await page.waitForFunction(() => !/other/.test(document.querySelector('tbody').textContent))
})

test('shows thousands of recordings without drawing them', async () => {
  // What the server would answer for so many: none is made here.
  await visit('')
  await page.route(/\/api\/databases\/demo$/, async (route) => {
    const answer = await (await route.fetch()).json(), [one] = answer.recordings
    await route.fulfill({ json: { ...answer, recordings: Array.from({ length: 20_000 }, (_, k) => ({ ...one, name: `take ${k + 1}`, signer: `signer ${k % 7}`, defects: k % 5 })) } })
  })
  await page.evaluate(() => (location.hash = '#/mine'))
  await page.waitForFunction(() => /plain/.test(document.querySelector('tbody')?.textContent))
  await page.evaluate(() => (location.hash = '#/demo'))
  await page.waitForFunction(() => /take 1\b/.test(document.querySelector('tbody')?.textContent))
  assert.ok((await page.locator('tbody tr').count()) < 60)
  const list = page.getByRole('region', { name: 'All recordings', exact: true })
  await list.focus()
  await page.keyboard.press('End')
  await page.getByRole('link', { name: 'take 20000', exact: true }).waitFor()
  assert.ok((await page.locator('tbody tr').count()) < 60)
  await page.getByRole('searchbox').fill('take 1999')
  await page.getByText('11 of 20,000').waitFor()
})

/** Few pixels are drawn quickly. */
const kSmall = { width: 960, height: 600 }
const draft = () => page.evaluate(() => JSON.parse(localStorage.getItem('signweave.review.mine/plain') ?? 'null')?.review.phases)
const progress = () => page.locator('.progress strong').textContent()
const press = async (...keys) => { for (const key of keys) await page.keyboard.press(key) }
/** Until the page of a recording's phases draws the signer. */
const bench = () => page.waitForFunction(() => document.querySelector('.bench[data-ready]') && window.signweaveStage?.panes[0]?.seen, null, { timeout: 60_000 })
const near = (value, wanted) => assert.ok(Math.abs(value - wanted) < 1e-3, `${value} is not ${wanted}`)
const all = ({ right, left }) => [...right, ...left].toSorted((a, b) => a.begin - b.begin || (a.hand === 'right' ? -1 : 1))

test('reviews proposed phases by keyboard', async () => {
  await visit('#/mine/phases/plain', { size: kSmall })
  await bench()
  const count = Number(/0 of (\d+) decided/.exec(await progress())[1])
  assert.ok(count > 4, `${count} proposals`)
  assert.match(await page.locator('main').textContent(), /Proposed from motion alone: a person must check each/)
  assert.deepEqual((await page.locator('.names li').allTextContents()).filter(Boolean).slice(0, 4), ['Right hand', 'Left hand', 'Gloss', 'Phase'])
  await press('ArrowDown', 'v')
  const proposed = all(await draft())
  const spanOf = async () => (({ loop }) => [loop.begin, loop.end].map((seconds) => Math.round(1000 * seconds)))(await transport(page))
  assert.deepEqual(await spanOf(), [proposed[0].begin, proposed[0].end])
  await press('Space')
  await page.waitForFunction(([from, to]) => window.signweaveStage.transport.playing && window.signweaveStage.transport.time > from / 1000 && window.signweaveStage.transport.time < to / 1000, [proposed[0].begin, proposed[0].end])
  await press('Space', 'Enter', 'Delete')
  assert.equal(await progress(), `2 of ${count} decided`)
  let now = all(await draft())
  assert.deepEqual(now.slice(0, 3).map(({ state }) => state), ['accepted', 'rejected', 'open'])
  // A border by a frame and by ten; the picture is there.
  const [, , third] = now
  await press('w', 'Shift+P')
  near((await transport(page)).time, (third.end + 100 - 10) / 1000)
  await press('Shift+W')
  near((await transport(page)).time, (third.begin + 110) / 1000)
  assert.deepEqual(await spanOf(), [third.begin + 110, third.end + 100])
  now = await draft()
  for (const hand of ['right', 'left']) for (let i = 1; i < now[hand].length; ++i) assert.ok(now[hand][i].begin >= now[hand][i - 1].end, 'phases overlap')
  // Split, merge, and all of it undone and done again.
  await press('ArrowRight', 'x')
  assert.equal(await progress(), `2 of ${count + 1} decided`)
  await press('m')
  assert.equal(await progress(), `2 of ${count} decided`)
  for (let i = 0; i < 4; ++i) await page.keyboard.press('Control+z')
  assert.deepEqual(await spanOf(), [third.begin + 10, third.end])
  for (let i = 0; i < 4; ++i) await press('y')
  assert.deepEqual(await draft(), now)
  await page.keyboard.press('Shift+Enter')
  assert.equal(await progress(), `${count} of ${count} decided`)
  await press('z')
  // It is kept until it is stored; letters are keys only where they may be.
  await page.evaluate(() => localStorage.setItem('signweave.keys', 'off'))
  await page.reload()
  await bench()
  await page.evaluate(() => localStorage.removeItem('signweave.keys'))
  assert.equal(await progress(), `2 of ${count} decided`)
  assert.match(await page.locator('main').textContent(), /Taken up where you left it/)
  await press('ArrowDown', 'x', 'v')
  assert.deepEqual(await draft(), now)
})

test('reviews phases by mouse and buttons', async () => {
  await visit('#/mine/phases/plain', { size: kSmall })
  await bench()
  await button('All').click()
  const lane = await page.getByRole('slider', { name: 'Time' }).boundingBox()
  const { duration } = await transport(page)
  const x = (ms) => lane.x + (ms / 1000 / duration) * lane.width, kRight = lane.y + 24 + 12
  const { right } = await draft()
  const one = right.reduce((longest, phase) => (phase.end - phase.begin > longest.end - longest.begin ? phase : longest))
  await page.mouse.click(x((one.begin + one.end) / 2), kRight)
  await page.getByText('Right hand ·').waitFor()
  const read = async () => (await draft()).right.find(({ id }) => id === one.id)
  // The end, dragged: not a step but one that can be undone.
  await page.mouse.move(x(one.end), kRight)
  assert.equal(await page.locator('.lane').evaluate((element) => element.style.cursor), 'ew-resize')
  await page.mouse.down()
  await page.mouse.move(x(one.end) - 30, kRight)
  await page.mouse.move(x(one.end) - 60, kRight, { steps: 2 })
  await page.mouse.up()
  const moved = await read()
  assert.ok(Math.abs(moved.end - (one.end - (60 / lane.width) * duration * 1000)) < 15, `${one.end} became ${moved.end}`)
  await button('Undo').click()
  assert.equal((await read()).end, one.end)
  await button('End: -1 frames').or(button('End: −1 frames')).click()
  assert.equal((await read()).end, one.end - 10)
  await page.getByRole('button', { name: 'hold', exact: true }).click()
  assert.equal((await read()).kind, 'hold')
  await button('Reject').click()
  assert.equal((await read()).state, 'rejected')
  for (let i = 0; i < 3; ++i) await button('Undo').click()
  assert.equal((await read()).kind, one.kind)
})

test('saves checked phases beside what is annotated, as EAF and in the database, and takes them up again', async () => {
  await visit('#/mine/phases/plain', { size: kSmall })
  await bench()
  const before = await annotation('plain')
  await press('Shift+Enter')
  const { right, left } = await draft()
  const wanted = { 'Phase RH (checked)': right.filter(({ state }) => state === 'accepted'), 'Phase LH (checked)': left.filter(({ state }) => state === 'accepted') }
  await button('Save…').click()
  await page.getByLabel('Who checked them').fill('Zoé <b>')
  const coming = page.waitForEvent('download')
  await button('Save as EAF').click()
  const eaf = join(folder, 'checked', 'plain.eaf')
  await (await coming).saveAs(eaf)
  // The program reads it, and every line that was there is there but one, the last annotation's number.
  const info = execFileSync(kSignweave, ['info', eaf], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] })
  for (const [tier, phases] of Object.entries(wanted)) assert.match(info, new RegExp(`${tier.replace(/[()]/g, '\\$&')} +checked phase +${phases.length}\\b`))
  const written = readFileSync(eaf, 'utf8'), lines = new Set(written.split('\n'))
  assert.deepEqual(before.split('\n').filter((line) => !lines.has(line)).map((line) => line.trim().split('"')[1]), ['lastUsedAnnotationId'])
  assert.match(written, /ANNOTATOR="signweave, checked by Zoé &lt;b&gt;"/)
  const database = join(folder, 'checked', 'round.db')
  execFileSync(kSignweave, ['create', database], { stdio: 'ignore' })
  assert.match(execFileSync(kSignweave, ['import', database, eaf, '--phase-tier', 'Phase RH (checked)'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }), /plain: added.*36 signs/)
  // In the database: what signs' phases are taken from is asked first.
  await button('Store in the database…').click()
  await page.getByText('The annotation of plain in mine is replaced').waitFor()
  assert.ok(await page.getByLabel('as now: Phase').isChecked())
  await page.getByLabel('the checked phases: Phase RH (checked)').check()
  await button('Store in the database').click()
  await page.getByText('Stored: annotation replaced').waitFor({ timeout: 60_000 })
  assert.equal(await annotation('plain'), written)
  const query = encodeURIComponent('phase = stroke')
  const strokes = await (await fetch(`${address}/api/databases/mine/query?text=${query}`)).json()
  const ours = strokes.filter(({ recording }) => recording === 'plain')
  assert.ok(ours.length > 0 && ours.every(({ tier }) => tier === 'Phase RH (checked)' || tier === 'Gloss'), JSON.stringify(ours.slice(0, 3)))
  await page.keyboard.press('Escape')
  assert.equal(await draft(), undefined)
  // A second review begins with what was stored.
  await page.reload()
  await bench()
  assert.match(await page.locator('main').textContent(), /Taken up from what is stored with the recording/)
  assert.deepEqual((await page.locator('.names li').allTextContents()).filter(Boolean).slice(0, 4), ['Right hand', 'Left hand', 'Gloss', 'Phase'])
  const decided = Object.values(wanted).flat().length
  assert.equal(await progress(), `${decided} of ${decided} decided`)
  await press('ArrowDown', 'Delete', 'z')
  assert.deepEqual(all(await draft()).map(({ begin, end, kind }) => [begin, end, kind]), all({ right: wanted['Phase RH (checked)'], left: wanted['Phase LH (checked)'] }).map(({ begin, end, kind }) => [begin, end, kind]))
})

for (const [theme, language] of [['dark', 'en'], ['light', 'fr']]) {
  for (const size of [{ width: 1280, height: 720 }, { width: 390, height: 844 }]) {
    test(`an accessibility checker finds nothing in the corpus, ${theme}, ${language}, ${size.width} wide`, async () => {
      if (!page) await visit('')
      await page.evaluate(([t, l]) => (localStorage.setItem('signweave.theme', t), localStorage.setItem('signweave.language', l)), [theme, language])
      const found = []
      const check = async (what) => {
        found.push(...(await axeFaults(page)).map((fault) => `${what}: ${fault}`))
        const wide = await page.evaluate(() => (document.scrollingElement.scrollWidth <= innerWidth && document.querySelector('main').scrollWidth <= innerWidth ? []
          : [...document.querySelectorAll('main *')].filter((element) => element.getBoundingClientRect().right > innerWidth && !element.closest('.scroll, .rows')).map(({ outerHTML }) => outerHTML.slice(0, 100))))
        assert.deepEqual(wide, [], `${what} is wider than the screen`)
      }
      await visit('#/mine/import', { size })
      await page.locator('input[type=file]:not([webkitdirectory])').setInputFiles([...files('axe', { seconds: 2 }), join(folder, 'broken.bvh')])
      await drop([['film.mp4', 'x']])
      await page.waitForFunction(() => document.querySelectorAll('.list .line').length === 5)
      await check('files')
      await page.locator('.acts .primary').click()
      await page.locator('article').waitFor({ timeout: 60_000 })
      await page.locator('.report .name').first().click()
      await page.locator('.report > details > summary').click()
      await check('report')
      await visit('#/mine', { size })
      await page.locator('tbody button').first().click()
      await page.locator('dl').waitFor()
      await check('recordings')
      await page.locator('.head button').last().click()
      await check('storage')
      await visit('#/mine/phases/plain', { size })
      await bench()
      await press('ArrowDown', 'Enter', 'ArrowDown')
      await page.locator('details summary').click()
      await check('phases')
      await page.locator('.primary', { hasText: /…/ }).click()
      await page.locator('dialog').waitFor()
      await check('saving')
      assert.deepEqual(found, [])
    })
  }
}

test('leaves the database as it was', async () => {
  await visit('')
  await page.evaluate(() => { for (const key of ['theme', 'language', 'checker', 'review.mine/plain']) localStorage.removeItem(`signweave.${key}`) })
  await visit('#/mine')
  await page.getByLabel('Choose all that are shown').check()
  await button('Remove').click()
  await page.getByRole('dialog').getByRole('button', { name: 'Remove' }).click()
  await page.getByText('Nothing here yet').waitFor({ timeout: 60_000 })
  assert.deepEqual(await stored(), [])
})
