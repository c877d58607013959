// The report of an import shows a recording's motion, before and after corrections.
import assert from 'node:assert/strict'
import { mkdirSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { begin, button, choose, files, look, row, stored } from './corpus_tools.mjs'
import { folder, mainTest, page, test, visit } from './suite.mjs'
import { frames, until } from './waits.mjs'

/** Returns the labels of the figures drawn, from the left. */
const drawn = () =>
  page
    .locator('article canvas[data-seconds]')
    .evaluateAll((all) => all.map(({ dataset }) => Object.fromEntries(Object.entries(dataset).map(([k, v]) => [k, +v]))))
const shown = (count) => page.locator(`section[data-shown="${count}"]`).waitFor()
const titles = () => page.locator('article figcaption').allTextContents()
const toPreview = () => page.locator('#preview-title').evaluate((title) => title.scrollIntoView())
/** Records preview requests from now on. */
function asked() {
  const all = []
  page.on('request', (request) => /\/preview$/.test(request.url()) && all.push(JSON.parse(request.postData())))
  return all
}

/** A person as bones with the CMU's names: parent, direction (x to the left, y to the back, z up), length in metres. */
const kBones = [
  ['lowerback', 'root', [0, 0, 1], 0.12],
  ['upperback', 'lowerback', [0, 0, 1], 0.12],
  ['thorax', 'upperback', [0, 0, 1], 0.12],
  ['lowerneck', 'thorax', [0, 0, 1], 0.1],
  ['upperneck', 'lowerneck', [0, 0, 1], 0.08],
  ['head', 'upperneck', [0, 0, 1], 0.18],
  ...[
    ['l', 1],
    ['r', -1],
  ].flatMap(([side, left]) => [
    [`${side}clavicle`, 'thorax', [left, 0, 0], 0.18],
    [`${side}humerus`, `${side}clavicle`, [0.2 * left, 0, -0.98], 0.29],
    [`${side}radius`, `${side}humerus`, [0, -0.6, -0.8], 0.24],
    [`${side}wrist`, `${side}radius`, [0, -0.6, -0.8], 0.08],
    [`${side}hand`, `${side}wrist`, [0, -0.6, -0.8], 0.08],
    [`${side}hipjoint`, 'root', [left, 0, 0], 0.1],
    [`${side}femur`, `${side}hipjoint`, [0, 0, -1], 0.45],
    [`${side}tibia`, `${side}femur`, [0, 0, -1], 0.43],
    [`${side}foot`, `${side}tibia`, [0, -0.9, -0.44], 0.15],
  ]),
]
const lines = (...all) => all.map((line) => `${line}\n`).join('')
/** ASF and AMC with a vertical z axis, which the formats do not specify: two seconds in which an arm is raised. */
function zUp(name) {
  const bones = kBones.map(([bone, , direction, length], id) =>
    lines(
      'begin',
      `id ${id + 1}`,
      `name ${bone}`,
      `direction ${direction.join(' ')}`,
      `length ${length}`,
      'axis 0 0 0 XYZ',
      ...(bone === 'rhumerus' ? ['dof rx', 'limits (-180 180)'] : []),
      'end',
    ),
  )
  const below = new Map()
  for (const [bone, from] of kBones) below.set(from, [...(below.get(from) ?? []), bone])
  const tree = [...below].map(([from, to]) => `${from} ${to.join(' ')}`)
  const root = [':root', 'order TX TY TZ RX RY RZ', 'axis XYZ', 'position 0 0 0', 'orientation 0 0 0']
  const asf =
    lines(':version 1.10', `:name ${name}`, ':units', 'mass 1.0', 'length 1.0', 'angle deg', ...root, ':bonedata') +
    bones.join('') +
    lines(':hierarchy', 'begin', ...tree, 'end')
  const moments = Array.from({ length: 240 }, (_, k) => `${k + 1}\nroot 0 0 0.95 0 0 0\nrhumerus ${k / 3}\n`)
  const into = join(folder, 'files')
  mkdirSync(into, { recursive: true })
  writeFileSync(join(into, `${name}.asf`), asf)
  writeFileSync(join(into, `${name}.amc`), `:FULLY-SPECIFIED\n:DEGREES\n${moments.join('')}`)
  return [join(into, `${name}.asf`), join(into, `${name}.amc`)]
}
/** A BVH file whose root has its rotation in place of its position, and its offset in place of the rotation. */
function permuted(text) {
  const offset = /ROOT[^]*?OFFSET\s+(.*)/.exec(text)[1].trim().split(/\s+/)
  const [head, rest] = text.split(/^(?=Frames:)/m)
  if (!rest) return text // an annotation
  const [count, time, ...lines] = rest.trimEnd().split('\n')
  const swapped = lines.map((line) => {
    const [, , , a, b, c, ...others] = line.trim().split(/\s+/)
    return [a, b, c, ...offset, ...others].join(' ')
  })
  return `${head}${[count, time, ...swapped].join('\n')}\n`
}

mainTest('shows a lying figure, and next to it the corrected one', async () => {
  await begin()
  await choose(zUp('walk'))
  await look()
  await toPreview()
  await shown(1)
  await until(async () => assert.deepEqual(await titles(), ['Without corrections']))
  const label = () => page.getByRole('img', { name: /Stick figure of walk/ })
  await until(async () => assert.match(await label().getAttribute('aria-label'), /lying/))
  await page.locator('#one-up').selectOption('z')
  await shown(2)
  await until(async () => {
    const [before, after] = await drawn()
    assert.ok(Math.abs(before.rise) < 0.1 && before.height < 0.7, JSON.stringify(before))
    assert.ok(after.rise > 0.95 && after.height > 1.5 && after.height < 2, JSON.stringify(after))
    assert.ok(after.sides > 0.1, 'the body’s left is on the viewer’s right')
  })
  await until(async () => assert.deepEqual(await titles(), ['Without corrections', 'With the corrections']))
  await until(async () => assert.match(await label().nth(1).getAttribute('aria-label'), /1\.\d+ m high, upright, 120 frames per second/))
  // Previewing stores nothing.
  assert.deepEqual(
    (await stored()).map(({ name }) => name).filter((name) => name === 'walk'),
    [],
  )
  // A file that cannot be read with a correction shows the fault in its place, and the other preview stays.
  await page.locator('#one-source_rate').fill('0')
  await page.keyboard.press('Tab')
  await page.locator('article .panes').getByRole('alert').getByText('source_rate').waitFor()
  await until(async () => assert.deepEqual(await titles(), ['Without corrections']))
  // Half as many frames per second: half the speed.
  await page.locator('#one-source_rate').fill('30')
  await page.keyboard.press('Tab')
  await shown(2)
  await until(async () => {
    const [before, after] = await drawn()
    assert.ok(Math.abs(before.duration - 2) < 0.05 && Math.abs(after.duration - 4) < 0.05, JSON.stringify([before, after]))
  })
})

test('shows a figure that is a hundred times too large, and a mirrored one', async () => {
  await begin()
  await choose(files('large', { seconds: 6 }))
  await look()
  await toPreview()
  await shown(1)
  await page.locator('#one-unit').fill('m')
  await page.keyboard.press('Tab')
  await shown(2)
  await until(async () => {
    const [before, after] = await drawn()
    assert.ok(before.height > 1.4 && before.height < 2, JSON.stringify(before))
    assert.ok(Math.abs(after.height / before.height - 100) < 0.1, JSON.stringify(after))
  })
  await page.locator('#one-unit').fill('')
  await page.getByRole('checkbox', { name: /^Mirror/ }).check()
  await shown(2)
  await until(async () => {
    const [before, after] = await drawn()
    assert.ok(Math.abs(after.height - before.height) < 0.01)
    // The body is the same, and its parts named left are on the other side.
    assert.ok(before.sides > 0.05 && Math.abs(after.sides + before.sides) < 0.02, JSON.stringify([before, after]))
  })
})

test('plays both synchronized, unless paused or with reduced motion', async () => {
  await begin()
  await choose(files('steps', { seconds: 6 }))
  await look()
  await toPreview()
  await page.locator('#one-up').selectOption('z')
  await shown(2)
  const times = async () => (await drawn()).map(({ seconds }) => seconds)
  const moves = async () => {
    const [first] = await times()
    await until(async () => assert.notEqual((await times())[0], first))
  }
  await moves()
  await button('Pause').click()
  const [left, right] = await times()
  assert.equal(left, right)
  await frames(page)
  assert.deepEqual(await times(), [left, right])
  // Another view is drawn at once, at the same moment.
  const picture = () =>
    page
      .locator('article canvas')
      .first()
      .evaluate((canvas) => canvas.toDataURL())
  const before = await picture()
  await button('the side').click()
  await until(async () => assert.notEqual(await picture(), before))
  assert.deepEqual(await times(), [left, right])
  await button('Play').click()
  await moves()
  // Off screen it is paused.
  await page.locator('h2').first().scrollIntoViewIfNeeded()
  await page.setViewportSize({ width: 1280, height: 300 })
  await until(async () => {
    const at = await times()
    await frames(page, 10)
    assert.deepEqual(await times(), at)
  })
})

test('does not play automatically with reduced motion', async () => {
  await visit('#/mine/import', { still: true })
  await page.locator('.drop').waitFor()
  await choose(files('calm', { seconds: 6 }))
  await look()
  await toPreview()
  await shown(1)
  await until(async () => assert.equal((await drawn())[0].seconds, 0))
  await frames(page)
  assert.equal((await drawn())[0].seconds, 0)
  await button('Play').click()
  await until(async () => assert.ok((await drawn())[0].seconds > 0))
})

test('shows the effect of a fix when pointing at it', async () => {
  await begin()
  await choose(files('turned', { seconds: 2, change: (text) => (text.startsWith('HIERARCHY') ? permuted(text) : text) }))
  await look()
  await toPreview()
  await shown(1)
  const calls = asked()
  await page.getByText('Point at “Fix”').waitFor()
  const mend = page.locator('article').getByRole('button', { name: /^Fix: / })
  await mend.hover()
  await shown(2)
  await until(async () => assert.deepEqual(await titles(), ['Without corrections', 'With rotation_first, m']))
  assert.deepEqual(calls, [{ file: 'turned.bvh', root_order: 'rotation_first', root_unit: 'm' }])
  await page.locator('#preview-title').hover()
  await page.getByText('Point at “Fix”').waitFor()
  await until(async () => assert.deepEqual(await titles(), ['Without corrections']))
  // By keyboard; a preview already loaded is not requested again.
  await mend.focus()
  await shown(2)
  await page.keyboard.press('Enter')
  await until(async () => assert.deepEqual(await titles(), ['Without corrections', 'With the corrections']))
  assert.equal(calls.length, 1)
})

test('requests a preview only when it is visible', async () => {
  await begin()
  await page.setViewportSize({ width: 390, height: 500 })
  const calls = asked()
  await choose(['one', 'two', 'three'].flatMap((name) => files(name, { seconds: 1 })))
  await look()
  await row('two').click()
  await page.locator('#preview-title').waitFor()
  await frames(page)
  assert.deepEqual(calls, [])
  await toPreview()
  await shown(1)
  assert.deepEqual(calls, [{ file: 'two.bvh' }])
})

test('requests a failed preview again', async () => {
  await begin()
  await page.route('**/preview', (route) => route.fulfill({ status: 503, json: { error: { code: 'busy', message: 'too much is going on' } } }))
  await choose(files('again', { seconds: 1 }))
  await look()
  await toPreview()
  await page.locator('article .panes').getByRole('alert').getByText('too much is going on').waitFor()
  await page.unroute('**/preview')
  await page.locator('article .panes').getByRole('button', { name: 'Try again' }).click()
  await shown(1)
  await until(async () => assert.deepEqual(await titles(), ['Without corrections']))
})
