// The player and the list of recordings, by keyboard and mouse.
import assert from 'node:assert/strict'
import { writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { axeFaults, azimuth, colorAtJoint, isSkin, smallVideo, transport } from './page_tools.mjs'
import { kViewports } from './corpus_tools.mjs'
import { address, folder, kDeclared, mainTest, page, test, visit } from './suite.mjs'
import { drawn, frames, opened, signedLive, until } from './waits.mjs'

const near = (value, wanted, tolerance = 1e-3) => assert.ok(Math.abs(value - wanted) <= tolerance, `${value} is not ${wanted}`)
const button = (name) => page.getByRole('button', { name, exact: true })

mainTest('lists recordings, with their statistics and the plot', async () => {
  await visit('#/demo')
  await page.getByRole('searchbox').fill('vil')
  await until(async () => assert.deepEqual(await page.locator('tbody th a').allTextContents(), ['villes']))
  await page.getByRole('button', { name: 'Transitions of villes' }).click()
  await page.waitForFunction(() => /villes/.test(document.querySelector('#statistics-title').textContent))
  await page.waitForFunction(() => document.querySelector('section img')?.naturalWidth > 300)
  await until(async () => assert.match(await page.locator('[role=status]').textContent(), kDeclared))
})

test('opens a recording by keyboard alone, and shows it before the whole motion is loaded', async () => {
  await visit('#/demo')
  let free
  const held = new Promise((resolve) => (free = resolve))
  let pieces = 0
  await page.route(/recordings\/meteo\/motion/, async (route) => {
    if (++pieces > 1) await held
    await route.continue()
  })
  await page.keyboard.press('Tab')
  assert.equal(await page.evaluate(() => document.activeElement.textContent), 'Skip to content')
  for (let i = 0; i < 30; ++i) {
    await page.keyboard.press('Tab')
    if (await page.evaluate(() => document.activeElement.title === 'Open meteo')) break
  }
  assert.notEqual(await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle), 'none')
  await page.keyboard.press('Enter')
  // One piece has arrived, the rest is in progress: there is a picture.
  await opened(page, '#/demo/recording/meteo')
  const arrived = await page.evaluate(() => window.signweaveStage.panes.map(({ store }) => store.arrived / store.length))
  assert.ok(arrived.length === 1 && arrived[0] > 0 && arrived[0] < 0.5, `${arrived} of the motion had arrived before the first picture`)
  free()
  await opened(page, '#/demo/recording/meteo', true)
})

test('draws the plain body where the motion has its joints, when selected', async () => {
  await visit('#/demo/recording/meteo?at=2.2')
  await drawn(page)
  for (const joint of ['RightHandMiddle1', 'LeftHandMiddle1']) {
    assert.ok(isSkin(await colorAtJoint(page, joint)), `${joint}: ${await colorAtJoint(page, joint)}`)
  }
  assert.ok(!isSkin(await colorAtJoint(page, 'Spine2')))
  await until(async () => assert.equal(await page.getByText('No face captured').count(), 0))
})

test('says that a face without tracks is neutral', async () => {
  await visit('#/demo/recording/villes')
  await until(async () => assert.equal(await page.getByText('No face captured: the face is neutral').count(), 1))
})

mainTest('plays, steps and selects by keyboard', async () => {
  await visit('#/demo/recording/meteo?at=2.2')
  const { rate } = await transport(page)
  await page.keyboard.press('ArrowRight')
  near((await transport(page)).time, 2.2 + 1 / rate, 1e-6)
  await page.keyboard.press('Shift+ArrowLeft')
  near((await transport(page)).time, 2.2 - 9 / rate, 1e-6)
  await page.keyboard.press('ArrowDown')
  near((await transport(page)).time, 2.98)
  await page.keyboard.press('g')
  const { loop } = await transport(page)
  near(loop.begin, 2.98)
  near(loop.end, 4.35)
  await page.keyboard.press('>')
  await page.keyboard.press('>')
  near((await transport(page)).speed, 1.5)
  await page.keyboard.press('Space')
  // Until it has started again.
  const times = await page.evaluate(async () => {
    const { transport } = window.signweaveStage
    const seen = [transport.time]
    while (transport.playing && seen.at(-1) >= (seen.at(-2) ?? 0)) {
      await new Promise(requestAnimationFrame)
      seen.push(transport.time)
    }
    return seen
  })
  const [least, most] = [Math.min(...times), Math.max(...times)]
  assert.ok(times.at(-1) < times.at(-2) && least >= 2.98 && most < 4.35, `${least} to ${most}, and the selection is 2.98 to 4.35`)
  assert.equal((await transport(page)).playing, true)
  await page.keyboard.press('Space')
  await until(async () => assert.equal((await transport(page)).playing, false))
  await page.keyboard.press('Escape')
  await until(async () => assert.equal((await transport(page)).loop, null))
  await page.keyboard.press('End')
  const { time, duration } = await transport(page)
  near(time, duration)
})

test('draws without shadows and antialiasing in software', async () => {
  await visit('#/demo/recording/meteo?at=2.2')
  await drawn(page)
  const { shadows, smoothed } = await page.evaluate(() => {
    const { renderer } = window.signweaveStage
    return { shadows: renderer.shadowMap.enabled, smoothed: renderer.getContextAttributes().antialias }
  })
  assert.deepEqual({ shadows, smoothed }, { shadows: false, smoothed: false })
})

test('rotates and changes its view by keyboard and mouse', async () => {
  await visit('#/demo/recording/meteo?at=2.2')
  await page.keyboard.press('2')
  near(await azimuth(page), Math.PI / 2)
  await page.keyboard.press('1')
  await page.keyboard.press('l')
  near(await azimuth(page), Math.PI / 24)
  await page.mouse.move(500, 200)
  await page.mouse.down()
  await page.mouse.move(400, 200, { steps: 4 })
  await page.mouse.up()
  near(await azimuth(page), Math.PI / 24 + 0.8, 0.02)
  await page.keyboard.press('t')
  await until(async () => assert.equal(await button('Trails').getAttribute('aria-pressed'), 'true'))
  await button('Skeleton').click()
  await until(async () => assert.equal(await button('Skeleton').getAttribute('aria-pressed'), 'true'))
})

test('scrubs, selects and zooms on the timeline by mouse', async () => {
  await visit('#/demo/recording/meteo')
  const lane = await page.getByRole('slider', { name: 'Time' }).boundingBox()
  const { duration } = await transport(page)
  await page.mouse.click(lane.x + lane.width / 2, lane.y + 10)
  near((await transport(page)).time, duration / 2, 0.1)
  await page.mouse.click(lane.x + (2 / duration) * lane.width, lane.y + 36)
  near((await transport(page)).loop.begin, 1.2)
  near((await transport(page)).loop.end, 2.98)
  await page.mouse.move(lane.x + 300, lane.y + 36)
  await page.mouse.down()
  await page.mouse.move(lane.x + 400, lane.y + 36, { steps: 3 })
  await page.mouse.up()
  near((await transport(page)).loop.end - (await transport(page)).loop.begin, (100 / lane.width) * duration, 0.02)
  await page.keyboard.press('Home')
  await until(async () => assert.match(await page.getByRole('slider', { name: 'Time' }).getAttribute('aria-valuetext'), /^0:1\d\.\d{3}, /))
})

/** Returns the maximum distance of a joint of a signer's body from its position in the motion, in metres. */
const apart = (pane = 0) =>
  page.evaluate((index) => {
    const { body, model } = window.signweaveStage.panes[index]
    return Math.max(
      ...body.joints.map((joint, j) => {
        const e = joint.matrixWorld.elements,
          p = model.positions
        return Math.hypot(e[12] - p[3 * j], e[13] - p[3 * j + 1], e[14] - p[3 * j + 2])
      }),
    )
  }, pane)

test('shows the first character, matched by the names of its joints, with the captured face', async () => {
  await visit('')
  await page.evaluate(() => localStorage.removeItem('signweave.body'))
  await visit('#/demo/recording/meteo?at=2.2', { body: null })
  await drawn(page)
  const { joints, weights, character } = await page.evaluate(() => {
    const { body, motion } = window.signweaveStage.panes[0]
    return {
      joints: body.joints.filter(Boolean).length,
      weights: body.morphs.filter(({ influences, target }) => influences[target] !== 0).length,
      character: motion.character,
    }
  })
  const { characters } = await (await fetch(`${address}/api/characters`)).json()
  assert.equal(character, characters[0].name)
  await until(async () => assert.equal(await page.locator('.tools select').inputValue(), character))
  assert.ok(joints > 80 && weights > 3, `${joints} joints, ${weights} weights`)
  await until(async () => assert.ok((await apart()) < 1e-3, `a joint is ${await apart()} m from where the motion has it`))
  for (const joint of ['finger3_1_L', 'finger3_1_R']) assert.ok(isSkin(await colorAtJoint(page, joint)), `${joint}: ${await colorAtJoint(page, joint)}`)
  assert.ok(!isSkin(await colorAtJoint(page, 'spine03')))
  await until(async () => assert.equal(await page.getByText('No face captured').count(), 0))
})

test('lets the user choose the signer, keeps time and view, and remembers it', async () => {
  await visit('')
  await page.evaluate(() => localStorage.setItem('signweave.body', 'drawn'))
  await visit('#/demo/recording/meteo?at=2.2', { body: null })
  await page.keyboard.press('2')
  const who = () => page.locator('.tools select')
  await until(async () => assert.deepEqual((await who().locator('option').allTextContents()).toSorted(), ['Drawn', 'Man', 'Woman']))
  await who().selectOption('woman')
  await page.waitForFunction(() => window.signweaveStage.panes[0]?.body.morphs && window.signweaveStage.panes[0].seen)
  near((await transport(page)).time, 2.2, 1e-6)
  near(await azimuth(page), Math.PI / 2)
  await visit('#/demo/recording/meteo?at=2.2', { body: null })
  await until(async () => assert.equal(await page.evaluate(() => window.signweaveStage.panes[0].motion.character), 'woman'))
  await who().locator('option').nth(2).waitFor({ state: 'attached' })
  const all = await who()
    .locator('option')
    .evaluateAll((options) => options.map(({ value }) => value))
  await page.keyboard.press('c')
  const next = all[(all.indexOf('woman') + 1) % all.length]
  await page.waitForFunction((name) => window.signweaveStage.panes[0] && (window.signweaveStage.panes[0].motion.character ?? 'drawn') === name, next)
  await until(async () => assert.equal(await who().inputValue(), next))
})

test('shows both hands close up', async () => {
  await visit('#/demo/recording/meteo?at=7.6')
  await page.keyboard.press('4')
  await drawn(page)
  const seen = await page.evaluate(() => {
    const { cameras, model, store } = window.signweaveStage.panes[0]
    return ['RightHandMiddle1', 'LeftHandMiddle1'].map((name, k) => {
      const j = store.skeleton.joints.findIndex((joint) => joint.name === name),
        p = model.positions,
        { camera } = cameras[k]
      const at = camera.position.clone().set(p[3 * j], p[3 * j + 1], p[3 * j + 2])
      return { x: at.clone().project(camera).x, y: at.clone().project(camera).y, far: camera.position.distanceTo(at) }
    })
  })
  for (const { x, y, far } of seen) assert.ok(Math.abs(x) < 0.2 && Math.abs(y) < 0.2 && far < 1, JSON.stringify(seen))
})

test('keeps the hands in the picture, at rest and during signing', async () => {
  await visit('#/demo/recording/meteo', { whole: true })
  const outside = await page.evaluate(async () => {
    const stage = window.signweaveStage,
      [pane] = stage.panes,
      found = []
    const joints = pane.store.skeleton.joints.flatMap(({ name }, j) => (/Hand/.test(name) ? [j] : []))
    for (let time = 0; time < stage.transport.duration; time += 5.3) {
      stage.transport.seek(time)
      for (let i = 0; i < 200; ++i) {
        stage.touch()
        const from = stage.pictures
        while (stage.pictures === from) await new Promise(requestAnimationFrame)
        if (pane.camera.settled) break
      }
      const { camera } = pane.camera,
        p = pane.model.positions
      for (const j of joints) {
        const { x, y } = camera.position
          .clone()
          .set(p[3 * j], p[3 * j + 1], p[3 * j + 2])
          .project(camera)
        if (Math.abs(x) > 1 || Math.abs(y) > 1) found.push([time, j, x, y])
      }
    }
    return found
  })
  assert.deepEqual(outside, [])
})

test('shows an edited recording next to the original, sign by sign', async () => {
  await visit('#/demo/edit/meteo?replace=BRETAGNE%3DVANNES&replace=MATIN%232%3DLE%20MANS', { body: 'woman' })
  await until(async () =>
    assert.deepEqual(
      (await page.locator('.title').allTextContents()).map((text) => text.trim()),
      ['Recorded meteo', 'Generated meteo'],
    ),
  )
  const steps = await page.evaluate(() => [5, 29.3, 40].map((t) => window.signweaveStage.panes[0].timeOf(t)))
  near(steps[0], 5, 1e-6)
  assert.ok(Math.abs(steps[2] - 40) > 0.05, 'the original continues by time')
  await until(async () =>
    assert.deepEqual((await page.locator('.names li').allTextContents()).filter(Boolean).slice(0, 5), ['Gloss', 'Phase', 'Place', 'Source', 'Junction']),
  )
  await page.evaluate(() => (window.signweaveStage.transport.seek(29.4), window.signweaveStage.touch())) // both hands are up in both
  await drawn(page)
  for (const pane of [0, 1]) {
    await until(async () => assert.ok((await apart(pane)) < 1e-3))
    for (const joint of ['finger3_1_L', 'finger3_1_R']) assert.ok(isSkin(await colorAtJoint(page, joint, pane)), `${joint} of ${pane} is not seen`)
  }
  await page.getByLabel('Synchronise').selectOption('time')
  near(await page.evaluate(() => window.signweaveStage.panes[0].timeOf(40)), 40, 1e-6)
  await until(async () => assert.match(await page.locator('[role=status]').textContent(), kDeclared))
})

test('signs the utterance in an address', async () => {
  await visit('#/demo/sign/' + encodeURIComponent('VANNES MATIN , "LE MANS" PLUIE'), { whole: true })
  await page.waitForFunction(() => window.signweaveStage.transport.duration > 3)
  const { duration } = await transport(page)
  assert.ok(duration > 3 && duration < 12, `${duration} s`)
  await until(async () => assert.ok((await page.locator('.names li').allTextContents()).includes('Junction')))
  await until(async () => assert.match(await page.locator('[role=status]').textContent(), kDeclared))
  await visit('#/demo/sign/VANES')
  await until(async () => assert.match(await page.getByRole('alert').textContent(), /no sign 'VANES'.*VANNES/))
})

test('signs live, and stays close to the newest frame', async () => {
  await visit('#/demo/sign/VANNES%20MATIN?pace=live')
  const first = await transport(page)
  await page.waitForFunction((before) => window.signweaveStage.transport.duration > before + 1, first.duration)
  await until(async () => {
    const { duration, time } = await transport(page)
    assert.ok(duration - time < 1.5, `${duration - time} s behind`)
  })
})

test('signs another utterance live on request, and reports what cannot be signed', async () => {
  await visit('#/demo/sign/VANNES?pace=live')
  await signedLive(page, 'VANNES')
  const next = page.getByPlaceholder('Glosses in order')
  await next.fill('MATIN')
  await next.press('Enter')
  await signedLive(page, 'MATIN')
  await next.fill('NOBODY')
  await next.press('Enter')
  await page.waitForFunction(() => /no sign 'NOBODY'/.test(document.querySelector('[role=alert]')?.textContent))
  const before = await transport(page)
  await until(async () => assert.ok((await transport(page)).duration > before.duration, 'the stream stopped'))
})

test('stops its clock while frames are missing', async () => {
  await visit('')
  let free
  const held = new Promise((resolve) => (free = resolve))
  let pieces = 0
  await page.route(/recordings\/meteo\/motion/, async (route) => {
    if (++pieces > 1) await held // one piece has arrived, and no other is in progress
    await route.continue()
  })
  await page.evaluate(() => (location.hash = '#/demo/recording/meteo'))
  await opened(page, '#/demo/recording/meteo')
  await page.keyboard.press('Space')
  await page.waitForFunction(() => window.signweaveStage.transport.held)
  const { time, playing } = await transport(page)
  await frames(page)
  await until(async () => assert.ok(playing && (await transport(page)).time === time && time < 1.5, `${time}`))
  await until(async () => assert.equal(await page.getByText('Waiting for frames').count(), 1))
  free()
  await page.waitForFunction((from) => window.signweaveStage.transport.time > from + 0.2, time)
})

test('keeps what is loaded if the rest fails, and retries on request', async () => {
  await visit('')
  let pieces = 0
  await page.route(/recordings\/meteo\/motion/, (route) => (++pieces === 1 ? route.continue() : route.abort()))
  await page.evaluate(() => (location.hash = '#/demo/recording/meteo'))
  await opened(page, '#/demo/recording/meteo')
  await page.waitForFunction(() => /The server does not answer/.test(document.querySelector('[role=alert]')?.textContent))
  await until(async () => assert.equal(await page.locator('.stage canvas').count(), 1))
  await page.unroute(/recordings\/meteo\/motion/)
  await page.getByRole('button', { name: 'Try again' }).click()
  await opened(page, '#/demo/recording/meteo', true)
  await until(async () => assert.equal(await page.getByRole('alert').count(), 0))
})

test('switches between views without keeping their graphics, and focuses the content', async () => {
  await visit('#/demo/recording/meteo')
  await page.evaluate(() => (window.before = new WeakRef(window.signweaveStage)))
  for (let i = 0; i < 20; ++i) {
    await page.evaluate((name) => (location.hash = `#/demo/recording/${name}`), i % 2 ? 'meteo' : 'villes')
    await page.waitForFunction((name) => document.title.startsWith(name) && window.signweaveStage?.panes.length > 0, i % 2 ? 'meteo' : 'villes')
  }
  await until(async () => assert.equal(await page.evaluate(() => document.activeElement.id), 'content'))
  await until(async () => assert.equal(await page.evaluate(() => document.querySelector('.stage canvas').getContext('webgl2').isContextLost()), false))
  await page.evaluate(() => (location.hash = '#/demo'))
  await page.waitForFunction(() => window.signweaveStage === undefined)
})

test('fills the screen, with the recordings’ declarations', async () => {
  await visit('#/demo/recording/meteo?at=2.2')
  await page.keyboard.press('f')
  await page.waitForFunction(() => document.fullscreenElement?.matches('.player'))
  await until(async () => assert.match(await page.locator('.player [role=status]').textContent(), kDeclared))
  await page.keyboard.press('f')
  await page.waitForFunction(() => !document.fullscreenElement)
})

test('lets the user switch off character keys', async () => {
  await visit('#/demo/recording/meteo?at=2.2')
  await page.keyboard.press('?')
  await page.getByLabel('Use letters, digits and symbols as shortcuts').uncheck()
  await page.keyboard.press('Escape')
  await page.keyboard.press('t')
  await until(async () => assert.equal(await button('Trails').getAttribute('aria-pressed'), 'false'))
  await page.evaluate(() => localStorage.removeItem('signweave.keys'))
})

/** Whether the linked video is synchronized with the motion: it began 0.2 s earlier. */
async function videoInStep() {
  await page.waitForFunction(() => document.querySelector('video')?.readyState >= 1)
  await page.evaluate(() => (window.signweaveStage.transport.seek(0.5), window.signweaveStage.touch()))
  await page.waitForFunction(() => Math.abs(document.querySelector('video').currentTime - 0.7) < 0.05)
}

test('synchronizes a linked video: chosen by hand, or sent by the server', async () => {
  await visit('#/demo/recording/villes')
  await until(async () => assert.equal(await page.getByText('villes.webm').count(), 1))
  const film = await smallVideo(page)
  await page.locator('input[type=file]').setInputFiles({ name: 'villes.webm', mimeType: 'video/webm', buffer: film })
  await videoInStep()
  writeFileSync(join(folder, 'films/villes.webm'), film)
  await visit('#/demo/recording/villes')
  await until(async () => assert.match(await page.locator('video').getAttribute('src'), /\/media\/0$/))
  await videoInStep()
})

test('shows the help, and returns the focus', async () => {
  await visit('#/demo/recording/meteo')
  await button('Help').focus()
  await page.keyboard.press('?')
  await until(async () => assert.ok((await page.locator('dialog kbd').count()) > 20))
  await page.keyboard.press('Escape')
  await page.waitForFunction(() => !document.querySelector('dialog')) // the close event of a dialog comes later
  await until(async () => assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-label')), 'Help'))
})

for (const { size, name, set } of kViewports) {
  test(`an accessibility checker finds nothing, ${name}`, async () => {
    if (!page) await visit('')
    await set()
    const found = []
    for (const hash of [
      '#/demo',
      '#/demo/recording/meteo',
      '#/demo/recording/villes',
      '#/demo/edit/meteo?replace=BRETAGNE%3DVANNES',
      '#/demo/sign/VANNES',
      '#/demo/recording/nobody',
    ]) {
      await visit(hash, { size })
      if (hash === '#/demo/recording/meteo') await page.keyboard.press('g')
      found.push(...(await axeFaults(page)).map((fault) => `${hash}: ${fault}`))
      assert.ok(await page.evaluate(() => document.scrollingElement.scrollWidth <= innerWidth), `${hash} is wider than the screen`)
      if (hash === '#/demo/recording/meteo') {
        await page.keyboard.press('?')
        found.push(...(await axeFaults(page)).map((fault) => `help: ${fault}`))
      }
    }
    assert.deepEqual(found, [])
  })
}
