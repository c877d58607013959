// Composing: glosses as text and cards, tokens, junctions, files and videos, as a person would do it.
import assert from 'node:assert/strict'
import { button, cards, compose, field, pause, pick, saved, shown } from './compose_tools.mjs'
import { axeFaults, transport } from './page_tools.mjs'
import { decoded, readWebm } from './render_webm.mjs'
import { kViewports } from './corpus_tools.mjs'
import { context, kDeclared, mainTest, page, test, visit } from './suite.mjs'
import { until } from './waits.mjs'

const near = (value, wanted, tolerance = 1e-3) => assert.ok(Math.abs(value - wanted) <= tolerance, `${value} is not ${wanted}`)
const kScenario1 = 'LE-TEMPS-PREVU#1 VANNES MATIN#1 NUAGES#1 APRES-MIDI#1 PLUIE#1 MARSEILLE SOLEIL-BRILLER#1'

mainTest('signs glosses that are typed and completed, by keyboard alone', async () => {
  await visit('#/demo/compose')
  await button('Scenario 1: four words replaced by city signs').waitFor() // the glosses are loaded
  await field().focus()
  await page.keyboard.type('van')
  const options = page.locator('.box [role=option]')
  await until(async () => assert.deepEqual(await options.allTextContents(), ['VANNES 3 tokens']))
  await page.keyboard.press('ArrowDown')
  await until(async () => assert.equal(await options.first().getAttribute('aria-selected'), 'true'))
  await page.keyboard.press('Enter')
  await until(async () => assert.equal(await field().inputValue(), 'VANNES '))
  await shown('VANNES')
  await pause()
  await page.keyboard.type('main')
  await until(async () => assert.deepEqual(await options.locator('span:first-child').allTextContents(), ['DEMAIN']))
  await page.keyboard.press('Escape')
  await until(async () => assert.equal(await options.count(), 0))
  for (let i = 0; i < 4; ++i) await page.keyboard.press('Backspace')
  await page.keyboard.type('MATIN , "LE MANS" PLUIE ')
  await shown('VANNES MATIN , "LE MANS" PLUIE')
  await until(async () => assert.deepEqual(await cards(), ['VANNES', 'MATIN', 'LE MANS', 'PLUIE']))
  await until(async () => assert.ok((await page.locator('.names li').allTextContents()).includes('Junction')))
  const { duration } = await transport(page)
  assert.ok(duration > 3 && duration < 12, `${duration} s`)
  await until(async () => assert.match(await page.locator('.declarations').textContent(), kDeclared))
})

test('reports what cannot be signed, and keeps the previous result', async () => {
  await compose('VANNES')
  await field().press('End')
  await page.keyboard.type(' VANES ')
  await page.getByRole('alert').filter({ hasText: "no sign 'VANES'" }).waitFor()
  await until(async () => assert.match(await page.locator('.card').nth(1).textContent(), /not in this database/))
  await until(async () => assert.equal(await page.evaluate(() => window.signweaveStage.panes.length), 1))
  await page.keyboard.press('Control+z')
  await page.waitForFunction(() => !document.querySelector('[role=alert]'))
  await until(async () => assert.deepEqual(await cards(), ['VANNES']))
  await page.keyboard.type(' "LE MA')
  await page.keyboard.press('Enter')
  await until(async () => assert.match(await page.getByRole('alert').textContent(), /never closed: "LE MA/))
  await until(async () => assert.deepEqual(await cards(), ['VANNES']))
  // The fault is marked in the text, and its correction is offered.
  assert.equal(await page.locator('.compose mark').textContent(), '"LE MA')
  await button('Write VANNES "LE MA"').click()
  await until(async () => assert.deepEqual([await field().inputValue(), await cards()], ['VANNES "LE MA"', ['VANNES', 'LE MA']]))
})

test('offers suggestions, and applies one', async () => {
  await compose('VANNES')
  await field().fill('vannes le mans ')
  await page.getByRole('alert').filter({ hasText: "no signs 'vannes' and 'le mans'" }).waitFor()
  await button('VANNES "LE MANS"').click()
  await shown('VANNES "LE MANS"')
  await page.waitForFunction(() => !document.querySelector('[role=alert]'))
})

test('moves signs by mouse and by keyboard, removes them, and undoes every step', async () => {
  await compose('BONJOUR MATIN PLUIE')
  const [first, last] = [await page.locator('.card').first().boundingBox(), await page.locator('.card').last().boundingBox()]
  await page.mouse.move(first.x + 20, first.y + 20)
  await page.mouse.down()
  await page.mouse.move(last.x + last.width - 5, last.y + 20, { steps: 4 })
  await page.mouse.up()
  await until(async () => assert.equal(await field().inputValue(), 'MATIN PLUIE BONJOUR'))
  await page.locator('.card').last().focus()
  await page.keyboard.press('Enter') // no click followed the drag: this one is real
  await until(async () => assert.equal(await page.locator('aside h2').textContent(), 'BONJOUR'))
  await page.keyboard.press('Alt+ArrowLeft')
  await until(async () => assert.equal(await field().inputValue(), 'MATIN BONJOUR PLUIE'))
  const isLeft = () =>
    page.evaluate(() => document.activeElement.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft', altKey: true, bubbles: true, cancelable: true })))
  await page.locator('.junction').first().focus()
  assert.equal(await isLeft(), false) // the browser does not go back
  await page.locator('.card').nth(1).focus()
  await until(async () => assert.equal(await page.evaluate(() => document.activeElement.textContent.includes('BONJOUR')), true))
  await page.keyboard.press('Delete')
  await until(async () => assert.equal(await field().inputValue(), 'MATIN PLUIE'))
  await page.keyboard.press('Enter')
  await button('Duplicate').click()
  const another = page.getByRole('combobox', { name: 'Another sign' })
  await another.fill('"VANNES')
  await button('Replace').click()
  await until(async () => assert.match(await page.locator('#other-fault').textContent(), /never closed/))
  await another.fill('"VANNES"')
  await button('Replace').click()
  await until(async () => assert.equal(await field().inputValue(), 'MATIN PLUIE VANNES'))
  await another.pressSequentially('P')
  await page.keyboard.press('Control+z') // undoes the typing, not the sign
  await until(async () => assert.deepEqual([await another.inputValue(), await field().inputValue()], ['', 'MATIN PLUIE VANNES']))
  await page.locator('.card').last().focus()
  for (const before of ['MATIN PLUIE PLUIE', 'MATIN PLUIE', 'MATIN BONJOUR PLUIE', 'MATIN PLUIE BONJOUR', 'BONJOUR MATIN PLUIE']) {
    await page.keyboard.press('Control+z')
    await until(async () => assert.equal(await field().inputValue(), before))
  }
  await until(async () => assert.equal(await button('Undo').isDisabled(), true))
  await button('Redo').click()
  await page.keyboard.press('Control+Shift+z')
  await until(async () => assert.equal(await field().inputValue(), 'MATIN BONJOUR PLUIE'))
  await shown('MATIN BONJOUR PLUIE')
})

test('shows the tokens of a place with their costs, and signs the selected one', async () => {
  await compose('VANNES MATIN')
  await page.locator('.card').nth(1).click()
  const rows = page.locator('aside .token')
  await rows.first().waitFor()
  const said = await rows.allTextContents()
  assert.equal(said.length, 2)
  assert.match(said[0], /lowest cost/)
  assert.match(said[0], /handshape \d\.\d\d/)
  const [, token, source] = /^#(\d) (meteo \d+\.\d s)/.exec(said[1])
  await until(async () => assert.notEqual(await page.locator('.card').nth(1).locator('.source').textContent(), source))
  await rows.nth(1).click()
  await shown(`VANNES MATIN#${token}`)
  await until(async () => assert.equal(await page.locator('.card').nth(1).locator('.source').textContent(), source))
  await until(async () => assert.equal(await field().inputValue(), `VANNES MATIN#${token}`))
  await page.waitForFunction(() => /pinned/.test(document.querySelector('aside .token[aria-pressed=true]')?.textContent))
  await button('Use the lowest cost').click()
  await until(async () => assert.equal(await field().inputValue(), 'VANNES MATIN'))
})

test('moves from junction to junction, and loops the motion around each', async () => {
  await compose('VANNES MATIN PLUIE')
  await page.locator('.junction').first().click()
  await until(async () => assert.match(await page.locator('aside h2').textContent(), /Junction 1: VANNES – MATIN/))
  const junctions = await page.evaluate(async () => {
    const body = JSON.stringify({ utterance: 'VANNES MATIN PLUIE' })
    const { junctions, frames_per_second: rate } = await (
      await fetch('api/databases/demo/sign', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body })
    ).json()
    return junctions.map(({ frames, method }) => ({ begin: frames.begin / rate, end: frames.end / rate, method }))
  })
  await until(async () => {
    const { loop } = await transport(page)
    near(loop.begin, junctions[0].begin - 0.4)
    near(loop.end, junctions[0].end + 0.4)
  })
  await until(async () => assert.match(await page.locator('aside .fact').textContent(), new RegExp(junctions[0].method)))
  await button('Next junction').click()
  await until(async () => near((await transport(page)).loop.begin, junctions[1].begin - 0.4))
  await pause()
  await page.getByLabel('Pause').selectOption('comma')
  await shown('VANNES MATIN , PLUIE')
  await until(async () => {
    const { loop } = await transport(page)
    near(loop.end - loop.begin, junctions[1].end - junctions[1].begin + 0.8 + 0.35, 0.02)
  })
  await button('Repeat it').click()
  await until(async () => assert.equal((await transport(page)).loop, null))
  await page.keyboard.press('Escape')
})

test('compares two synchronized methods: the same signs, other transitions', async () => {
  await compose('VANNES SOLEIL-BRILLER')
  await page.locator('.junction').first().click()
  await page.getByRole('combobox', { name: 'With' }).selectOption('sine')
  await page.waitForFunction(() => window.signweaveStage.panes.length === 2 && window.signweaveStage.panes.every(({ store }) => store.arrived >= store.length))
  await pause()
  await until(async () =>
    assert.deepEqual(
      (await page.locator('.title').allTextContents()).map((one) => one.trim()),
      ['As composed', 'sine'],
    ),
  )
  const { loop } = await transport(page)
  const apart = await page.evaluate(
    ({ begin, end }) => {
      const [one, other] = window.signweaveStage.panes.map(({ store }) => store)
      const at = (store, frame) => [0, 1, 2].map((axis) => store.hand(frame, 1, axis))
      let inside = 0,
        outside = 0
      for (let frame = 0; frame < one.length; ++frame) {
        const far = Math.hypot(...at(one, frame).map((value, k) => value - at(other, frame)[k]))
        const time = frame / one.rate
        if (time > begin - 0.02 && time < end + 0.02) inside = Math.max(inside, far)
        else outside = Math.max(outside, far)
      }
      return { inside, outside, same: one.length === other.length, time: window.signweaveStage.panes[1].timeOf(1.5) }
    },
    { begin: loop.begin + 0.4, end: loop.end - 0.4 },
  )
  assert.ok(apart.same && apart.inside > 0.02 && apart.outside < 1e-4, JSON.stringify(apart))
  near(apart.time, 1.5, 0.02)
  await button('sine everywhere').click()
  await page.waitForFunction(() => new URLSearchParams(location.hash.split('?')[1]).get('transition') === 'sine')
  await page.getByRole('combobox', { name: 'With' }).selectOption('')
  await page.waitForFunction(() => window.signweaveStage.panes.length === 1)
  await page.waitForFunction(() => /sine/.test(document.querySelector('aside .fact').textContent))
})

test('sets method, duration and tempo of one junction, also for a recorded transition', async () => {
  await compose('MONTAGNE#1 NEIGE#1 VANNES#1')
  await page.locator('.junction').first().click()
  await pause()
  const fact = (wanted) => page.waitForFunction((text) => document.querySelector('aside .fact').textContent.includes(text), wanted)
  await fact('The recorded transition')
  await page.getByRole('combobox', { name: 'Transition' }).selectOption('gap')
  await fact('gap, ')
  await page.getByRole('combobox', { name: 'Duration' }).selectOption('own')
  await page.getByRole('spinbutton').fill('450')
  await page.keyboard.press('Enter')
  await fact('gap, 450 ms')
  await page.getByRole('combobox', { name: 'Tempo' }).selectOption('own')
  await page.getByRole('slider', { name: 'Custom' }).fill('1.5')
  await fact('gap, 300 ms')
  await until(async () => assert.match(await page.locator('.junction').last().getAttribute('aria-label'), /taught/))
  await page.waitForFunction(() => decodeURIComponent(location.hash).includes('junctions=1=gap,450ms,x1.5'))
  await button('Reset to the general settings').click()
  await fact('The recorded transition')
  await page.getByRole('combobox', { name: 'With' }).selectOption('sine') // next to the recorded transition, the one generated by the method
  await page.waitForFunction(() => window.signweaveStage.panes.length === 2)
  await until(async () => assert.ok(await page.evaluate(() => window.signweaveStage.panes[0].store.length !== window.signweaveStage.panes[1].store.length)))
})

test('sets the general duration, tempo and frame rate', async () => {
  await compose('VANNES MATIN', { duration: '300' })
  const { duration } = await transport(page)
  await until(async () => assert.equal(await page.locator('.junction .ms').textContent(), '300'))
  await page.getByLabel('Tempo').fill('2')
  await page.waitForFunction((before) => Math.abs(window.signweaveStage.transport.duration - before / 2) < 0.05, duration)
  await page.getByLabel('Frames per second').fill('50')
  await page.keyboard.press('Enter')
  await page.waitForFunction(() => window.signweaveStage.transport.rate === 50)
  await page.waitForFunction(() => /duration=300&tempo=2&rate=50/.test(location.hash))
  await page.reload()
  await page.waitForFunction(() => window.signweaveStage?.transport.rate === 50)
  await until(async () => assert.equal(await page.locator('aside input[type=number]').inputValue(), '300'))
})

mainTest('saves a project and opens it again by button and by drop; invalid files are reported, and nothing is lost', async () => {
  await compose('VANNES MATIN#2 , "LE MANS"', { tempo: '1.5' })
  const file = await saved(() => button('Save project').click())
  assert.equal(file.name, 'VANNES_MATIN_2_LE_MANS.signweave.json')
  assert.equal(JSON.parse(file.bytes).places[2].pause, 'comma')
  await pick('Open', 'Start over')
  await until(async () => assert.deepEqual(await cards(), []))
  await page.locator('input[type=file]').setInputFiles({ name: file.name, mimeType: 'application/json', buffer: file.bytes })
  await shown('VANNES MATIN#2 , "LE MANS"')
  await page.waitForFunction(() => /tempo=1.5/.test(location.hash))
  const drop = (text) =>
    page.evaluate((content) => {
      const files = new DataTransfer()
      files.items.add(new File([content], 'x.signweave.json'))
      document.querySelector('.compose').dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: files }))
    }, text)
  await drop(JSON.stringify({ ...JSON.parse(file.bytes), colour: 'red' }))
  await page.getByText('a field that this studio does not know: colour').waitFor()
  await until(async () => assert.deepEqual(await cards(), ['VANNES', 'MATIN#2', 'LE MANS']))
  await drop(String(file.bytes).replace('VANNES', 'PLUIE'))
  await shown('PLUIE MATIN#2 , "LE MANS"')
  await page.keyboard.press('Control+z')
  await until(async () => assert.deepEqual(await cards(), ['VANNES', 'MATIN#2', 'LE MANS']))
})

test('copies a link that opens the same project', async () => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write'])
  await compose('VANNES PLUIE', { transition: 'gap' })
  await button('Copy link').click()
  await page.getByText('Link copied').waitFor()
  const link = await page.evaluate(() => navigator.clipboard.readText())
  await page.goto('about:blank')
  await page.goto(link)
  await shown('VANNES PLUIE')
  await until(async () => assert.equal(await page.getByRole('combobox', { name: 'Transition' }).inputValue(), 'gap'))
  await page.evaluate(() => (location.hash = '#/demo/compose?utterance=A&tempo=fast'))
  await page.getByText('does not understand parts of the link: tempo').waitFor()
  await until(async () => assert.deepEqual(await cards(), ['A']))
  await page.getByRole('link', { name: 'Recordings' }).click()
  await page.locator('tbody').first().waitFor()
  await page.getByRole('link', { name: 'Compose' }).click() // a returning user continues with the previous state
  await page.locator('.card').waitFor()
  await until(async () => assert.deepEqual(await cards(), ['A']))
})

test('opens the paper’s scenarios with the original, and starts from a recording', async () => {
  await visit('#/demo/compose')
  await button('Scenario 1: four words replaced by city signs').dblclick() // is one step
  await page.waitForFunction(() => window.signweaveStage?.panes.length === 2)
  await pause()
  const text = await field().inputValue()
  assert.ok(text.includes(kScenario1) && text.endsWith('"LE MANS" BROUILLARD#1'), text)
  await until(async () => assert.equal((await cards()).length, 36))
  await until(async () =>
    assert.deepEqual(
      (await page.locator('.title').allTextContents()).map((one) => one.trim().slice(0, 14)),
      ['Recorded meteo', 'Generated BONJ'],
    ),
  )
  await until(async () => assert.equal(await page.locator('.junction:not(.kept)').count(), 8))
  const steps = await page.evaluate(() => [5, 40].map((t) => window.signweaveStage.panes[0].timeOf(t)))
  near(steps[0], 6.2, 0.05) // the result begins with the first sign
  assert.ok(Math.abs(steps[1] - 40) > 0.05)
  await button('Undo').click()
  await until(async () => assert.deepEqual([await cards(), await button('Undo').isDisabled()], [[], true]))
  await pick('Open', 'Scenario 2: the predictions of two days swapped')
  await page.waitForFunction(() => /#1 NUAGES#2 NUIT#1 EN-MER#1 MATIN#2 BROUILLARD#1 DEMAIN#1/.test(document.querySelector('.compose').dataset.made))
  await button('Compare with the original').click()
  await page.waitForFunction(() => window.signweaveStage.panes.length === 1)
  await pick('Open', 'villes')
  await page.waitForFunction(() => /^VANNES#1 /.test(document.querySelector('.compose').dataset.made))
  await until(async () => assert.equal(await page.locator('.junction:not(.kept)').count(), 4)) // where the signer rests for a second
  await until(async () => assert.ok((await field().inputValue()).includes('BREST#1 . NANTES#1')))
})

mainTest('downloads motion and annotation', async () => {
  await compose('VANNES MATIN')
  const get = (name) => saved(() => pick('Download', name))
  const bvh = await get(/^BVH/),
    glb = await get(/^GLB/),
    eaf = await get(/^EAF/)
  assert.deepEqual(
    [bvh, glb, eaf].map(({ name }) => name),
    ['VANNES_MATIN.bvh', 'VANNES_MATIN.glb', 'VANNES_MATIN.eaf'],
  )
  assert.match(String(bvh.bytes.subarray(0, 9)), /HIERARCHY/)
  assert.match(String(glb.bytes.subarray(0, 4)), /glTF/)
  assert.match(String(eaf.bytes), /placeholder shapes, not LSF[^]*taught \d+ ms: VANNES -&gt; MATIN/)
})

test('renders a video in the page, with the recordings’ declarations in every frame, and cancels one', async () => {
  await compose('VANNES', { tempo: '2' })
  const seconds = await page.evaluate(() => window.signweaveStage.panes[0].store.seconds)
  await pick('Download', /^WebM/)
  await page.getByLabel('Size').selectOption('1920x1080') // slow enough to be cancelled
  await button('Render the video').click()
  await page.getByText(/Frame [1-9]/).waitFor()
  await button('Cancel').click()
  await page.getByLabel('Size').selectOption('640x360')
  const film = await saved(() => button('Render the video').click())
  assert.equal(film.name, 'VANNES.webm')
  const webm = readWebm(film.bytes)
  assert.equal(webm.blocks.length, Math.floor(seconds * 30 + 1e-6) + 1)
  const pictures = await decoded(page, webm, webm.codec === 'V_VP9' ? 'vp09.00.21.08' : 'vp8')
  assert.deepEqual([...new Set(pictures.map(({ width, height }) => `${width} ${height}`))], ['640 360'])
  assert.ok(
    pictures.every(({ caption }) => caption > 300),
    `${pictures.map(({ caption }) => caption)}`,
  )
  await until(async () => assert.equal(await page.locator('dialog').count(), 0))
  await until(async () => assert.equal(await page.evaluate(() => window.signweaveStage.panes.length), 1))
})

test('reports if the browser cannot encode video', async () => {
  await compose('VANNES')
  await page.evaluate(() => delete window.VideoEncoder)
  await pick('Download', /^WebM/)
  await until(async () => assert.match(await page.locator('dialog [role=alert]').textContent(), /lacks WebCodecs/))
  await page.keyboard.press('Escape')
})

for (const { size, name, set } of kViewports) {
  test(`an accessibility checker finds nothing on the compose page, ${name}`, async () => {
    if (!page) await visit('')
    await set()
    const found = []
    const look = async (what) => {
      found.push(...(await axeFaults(page)).map((fault) => `${what}: ${fault}`))
      assert.ok(await page.evaluate(() => document.scrollingElement.scrollWidth <= innerWidth), `${what} is wider than the screen`)
    }
    try {
      await visit('#/demo/compose', { size })
      await page.locator('.empty button').first().waitFor()
      await look('nothing yet')
      await page.getByRole('combobox').first().press('ArrowDown')
      await look('completion')
      await compose('VANNES MATIN', {}, { size })
      await page.locator('.card').last().click()
      await page.locator('aside .token').first().waitFor()
      await look('tokens')
      await page.locator('.junction').first().click()
      await pause()
      await look('junction')
      await page.locator('.menu button').first().click()
      await look('menu')
    } finally {
      await page.evaluate(() => (localStorage.removeItem('signweave.theme'), localStorage.removeItem('signweave.language')))
    }
    assert.deepEqual(found, [])
  })
}
