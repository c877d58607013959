// Import and the list of recordings, as a person would use them.
import assert from 'node:assert/strict'
import { copyFileSync, existsSync, mkdirSync, readdirSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import {
  annotation,
  asBefore,
  begin,
  button,
  choose,
  faultsOf,
  files,
  kThanks,
  kViewports,
  look,
  row,
  settled,
  store,
  stored,
  storedOne,
} from './corpus_tools.mjs'
import { withServer } from './server.mjs'
import { address, context, folder, mainTest, page, test, visit } from './suite.mjs'
import { until } from './waits.mjs'

/** Drops files created in the page. */
const drop = (list) =>
  page.evaluate((all) => {
    const transfer = new DataTransfer()
    for (const [name, text] of all) transfer.items.add(new File([text], name))
    document.querySelector('main').dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }))
  }, list)
/** Drags files and folders of the disk over the page and drops them there, as from a desktop. */
const dropFromDisk = async (paths) => {
  const mouse = await context.newCDPSession(page)
  const data = { items: [], files: paths, dragOperationsMask: 1 }
  for (const type of ['dragEnter', 'dragOver', 'drop']) {
    await mouse.send('Input.dispatchDragEvent', { type, x: 640, y: 300, data })
    if (type === 'dragOver') await page.locator('.drop.over').waitFor()
  }
  await mouse.detach()
}
const names = () => page.locator('.list .line:not(.head) > :nth-child(1)').allTextContents()

test('accepts dropped files and folders, and reports at once what cannot be sent', async () => {
  await begin()
  const walk = ['walk.bvh', 'HIERARCHY\nROOT']
  await drop([walk, ['film.mp4', 'x'], ['notes.txt', 'x'], ['a:b.bvh', 'x'], ['.hidden.bvh', 'x']])
  await page.getByText('Files that cannot be sent: 4.').waitFor()
  await until(async () => assert.match(await page.locator('main').textContent(), /the server reads \.bvh .*\.eaf/))
  await until(async () => assert.match(await page.locator('main').textContent(), /videos are not stored/))
  await button('Remove them').click()
  await until(async () => assert.deepEqual(await names(), ['walk.bvh']))
  // By keyboard, too.
  await page.getByRole('grid', { name: 'Files' }).focus()
  await page.keyboard.press('Delete')
  await until(async () => assert.deepEqual(await names(), []))
  const days = join(folder, 'days')
  for (const day of ['one', 'two']) files('same', { into: join(days, day), seconds: 1 })
  writeFileSync(join(days, '.DS_Store'), 'x')
  await page.locator('input[webkitdirectory]').setInputFiles(days)
  await page.getByText('Several folders contain files of the same name').waitFor()
  await button('Prefix with the folder names').click()
  await until(async () =>
    assert.deepEqual(
      (await names()).map((name) => name.replace(/.*\//, '')),
      ['days_one_same.bvh', 'days_one_same.eaf', 'days_two_same.bvh', 'days_two_same.eaf'],
    ),
  )
})

mainTest('accepts a dropped folder with all its contents', async () => {
  await begin()
  const week = join(folder, 'week')
  const [, eaf] = files('monday', { into: join(week, 'early'), seconds: 1 })
  files('tuesday', { into: join(week, 'late', 'evening'), seconds: 1 })
  writeFileSync(join(week, 'late', '.DS_Store'), 'x')
  // Browsers return a folder's files by the hundred.
  mkdirSync(join(week, 'many'))
  for (let k = 0; k < 130; ++k) copyFileSync(eaf, join(week, 'many', `note ${1000 + k}.eaf`))
  await dropFromDisk([week, files('alone', { seconds: 1 })[0]])
  await page.getByText(/^Files: 135,/).waitFor()
  await page.getByText('Hidden files in folders that were skipped: 1.').waitFor()
  await until(async () => assert.equal(await page.locator('.drop.over').count(), 0))
  await until(async () =>
    assert.deepEqual((await names()).slice(0, 4), ['alone.bvh', 'week/early/monday.bvh', 'week/early/monday.eaf', 'week/late/evening/tuesday.bvh']),
  )
  // The files themselves are referenced: their current content is sent.
  rmSync(join(week, 'many'), { recursive: true })
  await button('Start over').click()
  await dropFromDisk([week])
  await page.getByText(/^Files: 4,/).waitFor()
  await look()
  await until(async () => assert.deepEqual(await page.locator('.report .name').allTextContents(), ['monday', 'tuesday']))
  await until(async () => assert.match(await row('monday').textContent(), /monday\s*new\s*1\.0 s\s*36/))
})

test('shows the progress in bytes, and sends again only what failed', async () => {
  await begin()
  await choose([...files('first'), ...files('second')])
  const put = []
  let broken = true
  await page.route(/\/files\//, (route) => {
    const name = decodeURIComponent(route.request().url().split('/').at(-1))
    put.push(name)
    return name === 'second.bvh' && broken ? route.abort() : route.continue()
  })
  await button('Send and inspect').click()
  await button('Send the rest').waitFor()
  await until(async () => assert.match(await page.locator('.list').textContent(), /not sent: The server does not answer/))
  assert.deepEqual(put.toSorted(), ['first.bvh', 'first.eaf', 'second.bvh', 'second.eaf'])
  broken = false
  put.length = 0
  // On a slow connection the number of bytes sent is shown, within a file, too; after cancelling, the file is still to be sent.
  const line = await context.newCDPSession(page)
  const speed = (uploadThroughput) => line.send('Network.emulateNetworkConditions', { offline: false, latency: 0, downloadThroughput: -1, uploadThroughput })
  await speed(200_000)
  await button('Send the rest').click()
  await page.waitForFunction(
    () =>
      /second\.bvh\s*motion\s*927 kB\s*[1-9]\d? %/.test(document.querySelector('.list').textContent) &&
      /Sending: 1\.\d MB of 1\.9 MB/.test(document.querySelector('.acts').textContent),
  )
  await button('Cancel').click()
  await button('Send the rest').waitFor()
  await speed(-1)
  await look()
  assert.deepEqual(put, ['second.bvh', 'second.bvh'])
  await until(async () => assert.deepEqual(await page.locator('.report .name').allTextContents(), ['first', 'second']))
  await until(async () => assert.equal((await stored()).length, 0))
})

mainTest('reports guesses, and stores corrections', async () => {
  await begin()
  const turned = (text) => text.replaceAll('Gloss"', 'Words"').replaceAll('Phase"', 'Parts"')
  writeFileSync(join(folder, 'broken.bvh'), 'HIERARCHY\nROOT')
  await choose([...files('plain'), ...files('other', { change: turned }), join(folder, 'broken.bvh')])
  await look()
  await until(async () => assert.match(await row('plain').textContent(), /plain\s*new\s*8\.0 s/))
  await until(async () => assert.match(await row('broken').textContent(), /cannot be read/))
  await row('broken').click()
  await until(async () => assert.match(await page.locator('article').textContent(), /broken\.bvh:2: expected '\{'/))
  await row('plain').click()
  const article = page.locator('article')
  for (const fact of [
    /Frames\s*800/,
    /Frames per second\s*100/,
    /Vertical axis\s*Y/,
    /Unit, m\s*0\.01/,
    /Mirrored\s*no/,
    /sign tier 'Gloss' guessed/,
    /frozen joint · 3 frames 171 to 287, RightHandRing3/,
    /Names follow MotionBuilder/,
    /synthetic motion: placeholder shapes/,
  ]) {
    await until(async () => assert.match(await article.textContent(), fact))
  }
  // One recording: the signer, a tier's role, a joint's part; all recordings: the unit.
  await page.locator('#one-signer').fill('Zoé')
  await page.getByLabel('Joint: left wrist').fill('LeftForeArm')
  await page.keyboard.press('Tab')
  await settled()
  await until(async () => assert.match(await article.textContent(), /LeftForeArm.*(two parts|already|before)|forearm/i))
  await until(async () => assert.equal(await page.getByLabel('Joint: left wrist').inputValue(), 'LeftForeArm', 'typed text was lost by a fault'))
  await button('Reset to the server’s guess').click()
  await page.getByLabel('Joint: jaw').fill('')
  await page.keyboard.press('Tab')
  await row('other').click()
  await page.getByLabel('Used as: Words').selectOption('signs')
  await page.getByLabel('Hand: Words').selectOption('right')
  await settled()
  await page.getByText('Corrections for all recordings').click()
  await page.locator('#all-unit').fill('0.02')
  await page.keyboard.press('Tab')
  await settled()
  await until(async () => assert.match(await article.textContent(), /Unit, m\s*0\.02/))
  await until(async () => assert.match(await article.textContent(), /Signs\s*36/))
  await page.getByRole('button', { name: /^Import 2$/ }).click()
  await page.getByText('Stored: 2').waitFor()
  await until(async () =>
    assert.deepEqual(
      (await stored()).map(({ name, signer }) => [name, signer]),
      [
        ['other', 'synthetic'],
        ['plain', 'Zoé'],
      ],
    ),
  )
  const plain = await storedOne('plain')
  assert.equal(plain.rig.parts.jaw, undefined)
  assert.ok(
    plain.defects.some(({ kind }) => kind === 'scale'),
    'it is not twice as tall',
  )
  await row('other').click()
  await page.getByRole('link', { name: 'Open' }).click()
  await page.waitForFunction(() => /recording\/other/.test(location.hash))
  // The import is still there on return.
  await page.goBack()
  await page.getByText('Stored: 2').waitFor()
})

test('reads a hand-written table of pairs and mapping file', async () => {
  await begin()
  await choose([...files('day1', { seconds: 2 }), ...files('notes', { motion: false })])
  await drop([
    ['pairs.csv', 'motion,annotation,signer\nfar/day1.bvh,eaf\\notes.eaf,Ada\ngone.bvh,\n'],
    ['map.rig', '# none\njaw =\npelvis = nope\n'],
  ])
  await page.getByText('Table of pairs, line 3: “gone.bvh” was not chosen.').waitFor()
  await look()
  await row('day1').click()
  await settled()
  // An invalid joint in the mapping file can be corrected here.
  await page.locator('article').getByRole('alert').getByText('nope').waitFor()
  await until(async () => assert.equal(await page.getByLabel('Joint: pelvis').inputValue(), 'nope'))
  await page.getByLabel('Joint: pelvis').fill('Hips')
  await page.keyboard.press('Tab')
  await settled()
  await until(async () => assert.match(await row('day1').textContent(), /new/))
  await until(async () => assert.deepEqual(await page.locator('.report .name').allTextContents(), ['day1']))
  await until(async () => assert.equal(await page.getByLabel('Annotation', { exact: true }).inputValue(), 'notes.eaf'))
  await page.getByText('In no recording, and not stored: day1.eaf').waitFor()
  await page.getByRole('button', { name: /^Import 1$/ }).click()
  await page.getByText('Stored: 1').waitFor()
  const one = await storedOne('day1')
  assert.deepEqual([one.signer, one.annotation_file, one.rig.parts.jaw], ['Ada', 'notes.eaf', undefined])
})

test('reports the effect on a known recording, and pairs files on request', async () => {
  await begin()
  const other = (text) => text.replace('>BONJOUR<', '>SALUT<')
  await choose([...files('plain', { change: other }), ...files('alone', { motion: false })])
  await look()
  await row('plain').click()
  await page.getByText('The database has the recording “plain”. The import changes: annotation (replaced)').waitFor()
  await row('alone').click()
  await until(async () => assert.match(await page.locator('article').textContent(), /it can be searched, not signed/))
  // The motion is paired with an annotation of another name, and separated again; unused files are reported.
  await page.getByLabel('Motion', { exact: true }).selectOption('plain.bvh')
  await settled()
  await until(async () => assert.deepEqual(await page.locator('.report .name').allTextContents(), ['plain']))
  await until(async () => assert.equal(await page.getByLabel('Annotation', { exact: true }).inputValue(), 'alone.eaf'))
  await page.getByText('In no recording, and not stored: plain.eaf').waitFor()
  await button('Split into two recordings').click()
  await settled()
  await row('plain').click()
  await page.getByLabel('Annotation', { exact: true }).selectOption('plain.eaf')
  await settled()
  await until(async () => assert.deepEqual(await page.locator('.report .name').allTextContents(), ['alone', 'plain']))
  await row('alone').getByRole('checkbox').uncheck()
  // With another unit it is a different motion: it is accepted only on confirmation.
  await row('plain').click()
  await page.locator('#one-unit').fill('0.03')
  await page.keyboard.press('Tab')
  await settled()
  await page.getByText(/The import would be rejected: .*is not the motion that recording 'plain' was imported from/).waitFor()
  await until(async () => assert.match(await row('plain').textContent(), /would be rejected/))
  await page.getByRole('button', { name: /^Import 1$/ }).click()
  await page.getByText('Not stored: 1').waitFor()
  await until(async () => assert.match(await page.locator('article').textContent(), /is not the motion that recording 'plain' was imported from/))
  await page.locator('article').getByLabel('Replace the stored motion and face').check()
  await settled()
  await page.getByText('The import changes: annotation (replaced), motion (replaced)').waitFor()
  await page.getByRole('button', { name: /^Import 1$/ }).click()
  await page.getByText('Stored: 1').waitFor()
  await until(async () => assert.match(await row('plain').textContent(), /motion replaced/))
  await until(async () => assert.match(await annotation('plain'), />SALUT</))
  await until(async () => assert.equal((await stored()).length, 3))
})

/** Holds calls whose address matches until they are released. */
async function held(what) {
  let go
  const gone = new Promise((resolve) => (go = resolve)),
    came = page.waitForRequest(what)
  await page.route(what, async (route) => (await gone, route.continue()), { times: 1 })
  return { came, go }
}
const uploads = () => {
  const seen = new Set()
  page.on('request', (request) => /\/uploads\/[^/]+\/inspect$/.test(request.url()) && seen.add(request.url().replace(/\/inspect$/, '')))
  return seen
}
/** Waits until the server has none of these uploads any more. */
async function given(seen) {
  for (const end = Date.now() + 30_000; (await Promise.all([...seen].map(async (url) => (await fetch(url)).status))).some((status) => status !== 404);) {
    assert.ok(Date.now() < end, 'an unused upload is still there')
    await new Promise((resolve) => setTimeout(resolve, 50))
  }
}

test('loses no correction, whether made during a job, invalid, or while the server is unreachable', async () => {
  await begin()
  const seen = uploads()
  await choose(['one', 'two'].flatMap((name) => files(name, { seconds: 2 })))
  // A cancelled inspection can only be restarted: this is reported.
  await page.route(/\/inspect$/, (route) => route.fulfill({ status: 202, json: { job: 'none' } }), { times: 1 })
  await page.route(/\/jobs\/none$/, (route) => route.fulfill({ json: { job: 'none', kind: 'inspect', state: 'cancelled', fraction: 0 } }))
  await button('Send and inspect').click()
  await page.getByText('Not inspected yet: “Inspect again” continues.').waitFor()
  await look()
  const article = page.locator('article'),
    importing = page.locator('.foot .primary')
  // While one is inspected again, the other is mirrored.
  const first = await held(/\/inspect$/)
  await row('one').click()
  await page.locator('#one-signer').fill('Ada')
  await page.keyboard.press('Tab')
  await first.came
  await row('two').click()
  await article.getByLabel('Mirror: the file’s space is left-handed').check()
  first.go()
  await settled()
  await until(async () => assert.match(await article.textContent(), /Mirrored\s*yes/))
  // An invalid joint stays as typed next to the fault, and can be corrected.
  await page.getByLabel('Joint: pelvis').fill('nope')
  await page.keyboard.press('Tab')
  await settled()
  await article.getByRole('alert').getByText('nope').waitFor()
  await until(async () => assert.match(await row('two').textContent(), /rejected/))
  await until(async () => assert.match(await article.textContent(), /Mirrored\s*yes/))
  await until(async () => assert.equal(await page.getByLabel('Joint: pelvis').inputValue(), 'nope'))
  await button('Reset to the server’s guess').click()
  await settled()
  await until(async () => assert.match(await row('two').textContent(), /new/))
  // The server is unreachable: nothing is imported without inspection.
  await page.route(/\/inspect$/, (route) => route.abort(), { times: 1 })
  await page.locator('#one-unit').fill('0.02')
  await page.keyboard.press('Tab')
  await page.getByText('Corrected, but not inspected since: 1.').waitFor()
  await until(async () => assert.match(await row('two').textContent(), /not inspected/))
  await until(async () => assert.ok(await importing.isDisabled()))
  assert.deepEqual(await faultsOf('the server is away'), [])
  await button('Try again').click()
  await settled()
  await until(async () => assert.match(await article.textContent(), /Unit, m\s*0\.02/))
  await until(async () => assert.ok(await importing.isEnabled()))
  // An upload from which nothing is imported is discarded when the window closes.
  await page.goto('about:blank')
  await given(seen)
})

test('imports the others if one is rejected, accepts no files meanwhile, and discards what is left out', async () => {
  await begin()
  const seen = uploads()
  await choose(['one', 'two', 'three'].flatMap((name) => files(name, { seconds: 2 })))
  await look()
  await row('one').click()
  await page.locator('#one-face_timecode').fill('99:99:99:99')
  await page.keyboard.press('Tab')
  await settled()
  await page.getByText('Left out because their corrections are rejected: 1.').waitFor()
  await row('three').getByRole('checkbox').uncheck()
  const stores = await held(/\/import$/)
  await page.getByRole('button', { name: /^Import 1$/ }).click()
  await stores.came
  await drop([['more.bvh', 'x']])
  await page.locator('.foot').getByRole('alert').getByText('Rejected, because files were being sent').waitFor()
  await page.locator('summary', { hasText: 'Files: 6' }).click()
  await page.getByRole('grid', { name: 'Files' }).focus()
  await page.keyboard.press('Delete')
  await until(async () => assert.equal(await page.getByRole('grid', { name: 'Files' }).locator('.line:not(.head)').count(), 6))
  await until(async () => assert.ok(await page.locator('input[webkitdirectory]').isDisabled()))
  assert.deepEqual(await faultsOf('something is under way'), [])
  stores.go()
  await page.getByText('Stored: 1').waitFor()
  await until(async () => assert.ok((await stored()).some(({ name }) => name === 'two')))
  await page.getByRole('link', { name: 'Recordings of mine' }).click()
  await given(seen)
  // Recordings left out are still known, and are sent again if wanted.
  await page.goBack()
  await row('three').getByRole('checkbox').check()
  await page.getByRole('button', { name: /^Import 1$/ }).click()
  await page.getByText('Stored: 2').waitFor()
})

test('imports recordings of signs, with a fix that the server suggests', async () => {
  if (!existsSync(kThanks)) return console.log('not run: no shared data (bvh/signon-thanks)')
  await begin()
  await choose(readdirSync(kThanks).map((name) => join(kThanks, name)))
  await look()
  await until(async () => assert.deepEqual(await page.locator('.report .name').allTextContents(), ['ISL Thanks', 'NGT Thanks', 'VGT Thanks']))
  await page.locator('article').getByRole('button', { name: 'Fix all 3 with this notice' }).click()
  await settled()
  await until(async () => assert.doesNotMatch(await page.locator('article').textContent(), /permuted/))
  await page.getByRole('button', { name: /^Import 3$/ }).click()
  await page.getByText('Stored: 3').waitFor()
  await until(async () => assert.ok((await storedOne('ISL Thanks')).defects.every(({ kind }) => kind !== 'permuted root')))
})

test('stores nothing with read-only access', async () => {
  await withServer(process.env.SITE, async (at) => {
    const reader = await context.newPage()
    try {
      await reader.goto(`${at}/#/demo/import`)
      await reader.getByText('demo is served read-only').waitFor()
      await until(async () => assert.equal(await reader.locator('input[type=file]').count(), 0))
      await reader.goto(`${at}/#/demo`)
      await reader.getByRole('button', { name: /Details of meteo/ }).click()
      await reader.getByRole('link', { name: 'Phases' }).waitFor()
      await until(async () => assert.equal(await reader.getByRole('button', { name: /Remove|Change storage/ }).count(), 0))
      await until(async () => assert.equal(await reader.getByRole('link', { name: 'Import' }).count(), 0))
    } finally {
      await reader.close()
    }
  })
})

test('finds recordings, sorts them, and opens the player at a defect', async () => {
  await visit('#/mine')
  const shown = () => page.locator('tbody th a').allTextContents()
  await page.getByRole('searchbox').fill('O')
  await until(async () => assert.ok((await shown()).includes('other') && !(await shown()).includes('plain')))
  await page.getByRole('searchbox').fill('')
  await page.getByLabel('Signer', { exact: true }).selectOption('Zoé')
  await until(async () => assert.deepEqual(await shown(), ['plain']))
  await page.getByLabel('Signer', { exact: true }).selectOption('*')
  await page.getByRole('button', { name: 'Name', exact: false }).first().focus()
  await page.keyboard.press('Enter')
  await until(async () =>
    assert.deepEqual(
      await shown(),
      (await stored()).map(({ name }) => name).toSorted((a, b) => b.localeCompare(a)),
    ),
  )
  await until(async () => assert.equal(await page.locator('th[aria-sort=descending]').count(), 1))
  await page.getByRole('button', { name: 'Details of plain' }).click()
  await page.getByRole('link', { name: 'frames 333 to 521' }).click()
  await page.waitForFunction(() => window.signweaveStage?.panes[0]?.seen && Math.abs(window.signweaveStage.transport.time - 3.33) < 1e-6)
})

test('changes the storage of recordings, and removes only what is confirmed', async () => {
  await visit('#/mine')
  await page.getByLabel('Select plain').check()
  await button('Change storage').click()
  await until(async () => assert.ok(await page.getByLabel('The selected ones: 1').isChecked()))
  await page.getByLabel('How motion is split').selectOption('by_joint_and_frame')
  await page.getByLabel('Frames per piece').fill('many')
  await until(async () => assert.ok(await button('Change').isDisabled()))
  await page.getByLabel('Frames per piece').fill('50')
  await button('Change').click()
  await page.getByText('Changed: 1 of 1').waitFor()
  await button('Close').click()
  await page.locator('tr', { hasText: 'plain' }).getByText('by_joint_and_frame:50').waitFor()
  await until(async () =>
    assert.deepEqual(
      (await stored()).filter(({ access_mode: mode }) => mode === 'by_joint_and_frame:50').map(({ name }) => name),
      ['plain'],
    ),
  )
  await page.getByRole('button', { name: 'Details of other' }).click()
  const before = (await stored()).length
  for (const [answer, after] of [
    ['Cancel', before],
    ['Remove', before - 1],
  ]) {
    await page.getByRole('button', { name: 'Remove other' }).click()
    await until(async () => assert.match(await page.getByRole('dialog').textContent(), /Remove from mine\?\s*other/))
    await page.getByRole('dialog').getByRole('button', { name: answer }).click()
    await page.waitForFunction(() => !document.querySelector('dialog'))
    await until(async () => assert.equal((await stored()).length, after))
  }
  await page.waitForFunction(() => !/other/.test(document.querySelector('tbody').textContent))
})

test('cancels a running change of storage, and reports what was done', async () => {
  // Pieces of a single frame take seconds.
  const kPieces = 'by_joint_and_frame:1'
  for (const [name, seconds] of [
    ['brief', 1],
    ['long', 50],
  ])
    await store(name, { seconds })
  const modes = async () => Object.fromEntries((await stored()).map(({ name, access_mode: mode }) => [name, mode]))
  const before = await modes()
  await visit('#/mine')
  for (const name of ['brief', 'long']) await page.getByLabel(`Select ${name}`, { exact: true }).check()
  await button('Change storage').click()
  await page.getByLabel('How motion is split').selectOption('by_joint_and_frame')
  await page.getByLabel('Frames per piece').fill('1')
  await page.getByLabel('Frames per piece').press('Enter')
  // Waits until it is in progress: the short one finishes soon.
  await page.waitForFunction(() => document.querySelector('dialog progress')?.value >= 50)
  await button('Cancel').click()
  await page.getByText('Cancelled: recordings changed so far stay changed, the others are unchanged.').waitFor()
  await page.getByText('Changed: 1 of 2').waitFor()
  await until(async () => assert.deepEqual(await modes(), { ...before, brief: kPieces }))
  // At once, by keyboard: nothing is done.
  await button('Change').click()
  await button('Cancel').focus()
  await page.keyboard.press('Enter')
  await page.getByText('Cancelled: nothing was changed.').waitFor()
  await until(async () => assert.deepEqual(await modes(), { ...before, brief: kPieces }))
  await button('Close').click()
  await page.locator('tr', { hasText: 'brief' }).getByText(kPieces).waitFor()
  const { faults } = await (await fetch(`${address}/api/databases/mine/check`)).json()
  assert.deepEqual(faults, [])
})

test('shows thousands of recordings without drawing them', async () => {
  // The server's answer for this many recordings, which are not created here.
  await visit('')
  await page.route(/\/api\/databases\/demo$/, async (route) => {
    const answer = await (await route.fetch()).json(),
      [one] = answer.recordings
    await route.fulfill({
      json: { ...answer, recordings: Array.from({ length: 20_000 }, (_, k) => ({ ...one, name: `take ${k + 1}`, signer: `signer ${k % 7}`, defects: k % 5 })) },
    })
  })
  await page.evaluate(() => (location.hash = '#/mine'))
  await page.waitForFunction(() => /plain/.test(document.querySelector('tbody')?.textContent))
  await page.evaluate(() => (location.hash = '#/demo'))
  await page.waitForFunction(() => /take 1\b/.test(document.querySelector('tbody')?.textContent))
  await until(async () => assert.ok((await page.locator('tbody tr').count()) < 60))
  const list = page.getByRole('region', { name: 'All recordings', exact: true })
  await list.focus()
  assert.ok(await list.evaluate((view) => view === document.activeElement))
  await page.keyboard.press('End')
  await page.getByRole('link', { name: 'take 20000', exact: true }).waitFor()
  await until(async () => assert.ok((await page.locator('tbody tr').count()) < 60))
  await page.keyboard.press('Home')
  await page.getByRole('link', { name: 'take 1', exact: true }).waitFor()
  await page.getByRole('searchbox').fill('take 1999')
  await page.getByText('11 of 20,000').waitFor()
})

for (const { name, size, set } of kViewports) {
  test(`an accessibility checker finds nothing in import and recordings, ${name}`, async () => {
    if (!page) await visit('')
    await set()
    const found = []
    await visit('#/mine/import', { size })
    await choose([...files('axe', { seconds: 2 }), join(folder, 'broken.bvh')])
    await drop([['film.mp4', 'x']])
    await page.waitForFunction(() => document.querySelectorAll('.list .line').length === 5)
    found.push(...(await faultsOf('files')))
    await page.locator('.acts .primary').click()
    await page.locator('article').waitFor()
    await page.locator('.report .name').first().click()
    await page.locator('.report > details > summary').click()
    await page.locator('#preview-title').scrollIntoViewIfNeeded()
    await page.locator('article canvas[data-seconds]').waitFor()
    found.push(...(await faultsOf('report')))
    await visit('#/mine', { size })
    await page.locator('tbody button').first().click()
    await page.locator('dl').waitFor()
    found.push(...(await faultsOf('recordings')))
    await page.locator('.head button').last().click()
    found.push(...(await faultsOf('storage')))
    assert.deepEqual(found, [])
  })
}

test('leaves the database unchanged', async () => {
  await visit('')
  await asBefore()
  await visit('#/mine')
  await page.getByLabel('Select all shown').check()
  await button('Remove').click()
  await page.getByRole('dialog').getByRole('button', { name: 'Remove' }).click()
  await page.getByText('Nothing here yet').waitFor()
  await until(async () => assert.deepEqual(await stored(), []))
})
