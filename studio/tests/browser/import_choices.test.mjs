// Choices about files before they are stored: which do not belong to a recording, and which parts to leave out.
import assert from 'node:assert/strict'
import { copyFileSync } from 'node:fs'
import { join } from 'node:path'
import { annotation, begin, button, choose, empty, files, look, row, settled, store, stored, storedOne } from './corpus_tools.mjs'
import { address, folder, page, test, visit } from './suite.mjs'
import { until } from './waits.mjs'

const article = () => page.locator('article').textContent()
const shown = () => page.locator('.report .name').allTextContents()
/** Records the names of files sent to the server and removed from it from now on. */
function requests() {
  const all = { sent: [], back: [] }
  page.on('request', (request) => {
    const name = decodeURIComponent(/\/files\/([^/]+)$/.exec(request.url())?.[1] ?? '')
    if (name && request.method() === 'PUT') all.sent.push(name)
    if (name && request.method() === 'DELETE') all.back.push(name)
  })
  return all
}

test('removes a face and an annotation from a recording, by mouse and by keyboard', async () => {
  await begin()
  const face = join(folder, 'files', 'walk.face.csv')
  const walk = files('walk', { seconds: 2 })
  copyFileSync(join(folder, 'corpus', 'meteo.face.csv'), face)
  await choose([...walk, face])
  await look()
  await until(async () => assert.match(await article(), /Face tracks\s*22/))
  await button('Remove: Face capture').click()
  await page.getByText('In no recording, and not stored: walk.face.csv').waitFor()
  await settled()
  await until(async () => assert.doesNotMatch(await article(), /Face tracks/))
  await until(async () => assert.equal(await page.getByLabel('Face capture', { exact: true }).inputValue(), ''))
  await until(async () => assert.ok(await page.getByLabel('Face capture', { exact: true }).evaluate((element) => element === document.activeElement)))
  await until(async () => assert.ok(await button('Remove: Face capture').isDisabled()))
  // By keyboard: the face again, and no annotation.
  await page.keyboard.press('w')
  await settled()
  await until(async () => assert.match(await article(), /Face tracks\s*22/))
  await button('Remove: Annotation').focus()
  await page.keyboard.press('Enter')
  await page.getByText('In no recording, and not stored: walk.eaf').waitFor()
  await settled()
  await until(async () => assert.match(await article(), /motion without annotation/))
  await button('Remove: Face capture').focus()
  await page.keyboard.press('Enter')
  await settled()
  await page.getByRole('button', { name: /^Import 1$/ }).click()
  await page.getByText('Stored: 1').waitFor()
  const one = await storedOne('walk')
  assert.deepEqual([one.motion_file, one.annotation_file || '', one.face_file || '', one.tracks?.length ?? 0], ['walk.bvh', '', '', 0])
})

test('specifies that no tier contains phases, or signs, for one recording and for all', async () => {
  await begin()
  await choose([...files('one', { seconds: 2 }), ...files('two', { seconds: 2 })])
  await look()
  await row('one').click()
  await until(async () => assert.match(await article(), /Phases\s*108/))
  await button('No phase tier (do not guess)').click()
  await settled()
  // A sign without annotated phases is a single phase.
  await until(async () => assert.match(await article(), /Signs\s*36.*Phases\s*36/))
  await until(async () => assert.equal(await page.getByLabel('Used as: Phase').inputValue(), ''))
  await until(async () => assert.doesNotMatch(await article(), /phase tier 'Phase' guessed/))
  // By keyboard, no signs either.
  await page.getByLabel('Used as: Gloss').focus()
  await page.keyboard.press('End')
  await settled()
  await until(async () => assert.match(await article(), /Signs\s*0/))
  await until(async () => assert.ok(await button('No sign tier (do not guess)').isDisabled()))
  await button('Reset to the server’s guess').click()
  await settled()
  await until(async () => assert.match(await article(), /Signs\s*36.*Phases\s*108/))
  // For all of them.
  await page.getByText('Corrections for all recordings').click()
  await page.getByRole('checkbox', { name: 'No phase tier (do not guess)' }).focus()
  await page.keyboard.press('Space')
  await settled()
  for (const name of ['one', 'two']) {
    await row(name).click()
    await until(async () => assert.match(await article(), /Signs\s*36.*Phases\s*36/))
  }
  await page.getByRole('button', { name: /^Import 2$/ }).click()
  await page.getByText('Stored: 2').waitFor()
  const found = await (await fetch(`${address}/api/databases/mine/query?text=${encodeURIComponent('phase = preparation')}`)).json()
  assert.deepEqual(found, [])
})

test('removes one file before the import, without sending or inspecting the others again', async () => {
  await begin()
  await choose([...files('first', { seconds: 1 }), ...files('second', { seconds: 1 }), ...files('third', { seconds: 1 })])
  await look()
  const { sent, back } = requests()
  await page.locator('summary', { hasText: 'Files: 6' }).click()
  await button('Remove second.eaf').click()
  await settled()
  await row('second').click()
  await until(async () => assert.match(await article(), /motion without annotation/))
  assert.deepEqual([back, sent.filter((name) => name !== 'pairs.csv')], [['second.eaf'], []])
  // By keyboard: the motion of the first, whose annotation then becomes a recording of its own, and all of the third.
  const list = page.getByRole('grid', { name: 'Files' })
  const marked = () => page.locator('.list [aria-selected=true] > :first-child').first().textContent()
  const at = async (name) => {
    await list.focus()
    await page.keyboard.press('Home')
    for (let k = 0; k < 6 && (await marked()) !== name; ++k) await page.keyboard.press('ArrowDown')
    await until(async () => assert.equal(await marked(), name))
  }
  for (const name of ['first.bvh', 'third.bvh', 'third.eaf']) {
    await at(name)
    await page.keyboard.press('Delete')
  }
  await settled()
  await until(async () => assert.deepEqual(await shown(), ['first', 'second']))
  await row('first').click()
  await until(async () => assert.match(await article(), /it can be searched, not signed/))
  await page.getByRole('button', { name: /^Import 2$/ }).click()
  await page.getByText('Stored: 2').waitFor()
  assert.deepEqual(back.toSorted(), ['first.bvh', 'second.eaf', 'third.bvh', 'third.eaf'])
  assert.deepEqual(
    sent.filter((name) => name !== 'pairs.csv'),
    [],
  )
  const first = await storedOne('first'),
    second = await storedOne('second')
  assert.deepEqual([first.motion_file || '', first.annotation_file, second.motion_file, second.annotation_file || ''], ['', 'first.eaf', 'second.bvh', ''])
  await until(async () => assert.ok((await stored()).every(({ name }) => name !== 'third')))
})

test('stores checked phases of a recording whose name contains a folder', async () => {
  const name = 'day 1/walk, far'
  await store('walk', { seconds: 3, called: name })
  const before = (await stored()).map((one) => one.name)
  await visit(`#/mine/phases/${encodeURIComponent(name)}`)
  await page.locator('.bench[data-ready]').waitFor()
  await page.keyboard.press('Shift+Enter')
  await button('Save…').click()
  await button('Store in the database…').click()
  await button('Store in the database').click()
  await page.getByText('annotation replaced').waitFor()
  await until(async () => assert.match(await annotation(name), /Phase RH \(checked\)/))
  await until(async () =>
    assert.deepEqual(
      (await stored()).map((one) => one.name),
      before,
    ),
  )
  await empty()
})
