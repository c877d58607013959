// Takes a picture of every view: screenshots.mjs SITE OUT_FOLDER [ONLY]. Inspect them at full size.
import { mkdirSync } from 'node:fs'
import { join } from 'node:path'
import { withBrowser } from './chromium.mjs'
import { likeACard } from './page_tools.mjs'
import { kScenario3, linkVideo, withServer } from './server.mjs'
import { drawn, opened } from './waits.mjs'

const [site, out, only = ''] = process.argv.slice(2)
const kEdit = '#/demo/edit/meteo?replace=BRETAGNE%3DVANNES&replace=DEMAIN%3DMARSEILLE&replace=VENDREDI%3DRENNES&replace=MATIN%232%3DLE%20MANS'
const kCompose = '#/demo/compose?' + new URLSearchParams({ utterance: 'VANNES MATIN , "LE MANS" PLUIE' })
const kDesk = { width: 1280, height: 720 },
  kPhone = { width: 390, height: 844 }
const kViews = [
  { name: 'start', hash: '#/' },
  { name: 'recordings', hash: '#/demo' },
  { name: 'recordings_empty', hash: '#/mine' },
  { name: 'recordings_statistics', hash: '#/demo', then: (page) => page.locator('tbody button').first().click(), tall: true },
  { name: 'front', hash: '#/demo/recording/meteo?at=2.2' },
  { name: 'left', hash: '#/demo/recording/meteo?at=2.2', keys: ['2'] },
  { name: 'right', hash: '#/demo/recording/meteo?at=2.2', keys: ['3'] },
  { name: 'hands', hash: '#/demo/recording/meteo?at=7.6', keys: ['4'] },
  { name: 'face', hash: '#/demo/recording/meteo?at=2.2', keys: ['5'] },
  { name: 'whole', hash: '#/demo/recording/meteo?at=9', keys: ['6'] },
  { name: 'video', hash: '#/demo/recording/villes?at=3' },
  { name: 'trails_skeleton', hash: '#/demo/recording/meteo?at=12.6', keys: ['t', 's', 'l', 'l', 'l', 'i', '+', '+', '+', '+', '+', 'g'] },
  { name: 'man', hash: '#/demo/recording/meteo?at=7.6', body: 'man' },
  { name: 'drawn', hash: '#/demo/recording/meteo?at=2.2', body: 'drawn' },
  { name: 'drawn_face', hash: '#/demo/recording/meteo?at=2.2', body: 'drawn', keys: ['5'] },
  { name: 'two_recordings', hash: '#/demo/recording/meteo?at=2.2&compare=villes' },
  { name: 'scenario_1', hash: kEdit, seek: 29.4, keys: ['+', '+', '+'] },
  { name: 'signed', hash: '#/demo/sign/' + encodeURIComponent('VANNES MATIN , "LE MANS" PLUIE'), keys: ['Space'], seek: 1.4 },
  { name: 'signed_lanes', hash: '#/channels/sign/' + encodeURIComponent(kScenario3), seek: 4.1 },
  { name: 'live', hash: '#/demo/sign/' + encodeURIComponent('VANNES MATIN') + '?pace=live' },
  { name: 'help', hash: '#/demo/recording/meteo?at=2.2', keys: ['?'] },
  {
    name: 'evaluate',
    hash: '#/demo/evaluate',
    body: 'drawn',
    then: async (page) => {
      await page.locator('form button.primary').click()
      await page.waitForSelector('#result-title', { timeout: 300_000 })
      await page.evaluate(() => document.querySelector('#result-title').scrollIntoView())
    },
  },
  {
    name: 'compare',
    hash: '#/demo/compare',
    still: true,
    then: async (page) => {
      await page.locator('form button.primary:enabled').click()
      await page.locator('input[name=fluency]').first().check()
      await page.locator('form button.primary:enabled').click()
      await page.waitForFunction(() => window.signweaveStage?.panes.length === 2 && window.signweaveStage.panes.every(({ seen }) => seen), null, {
        timeout: 120_000,
      })
      await page.evaluate(() => {
        const { transport } = window.signweaveStage
        transport.seek(transport.duration / 2)
        window.signweaveStage.touch()
      })
    },
  },
  {
    name: 'compare_viewers',
    hash: '#/demo/compare',
    then: async (page) => {
      await page.locator('form button.primary:enabled').click()
      await page.locator('input[name=fluency]').first().check()
      await page.locator('summary').click()
    },
  },
  { name: 'compare_setup', hash: '#/demo/compare', then: (page) => page.locator('form button.primary:enabled').waitFor() },
  { name: 'guide', hash: '#/demo/guide', then: (page) => page.locator('form button.primary:enabled').first().waitFor() },
  {
    name: 'guide_under_way',
    hash: '#/demo/guide',
    then: async (page) => {
      await page.locator('form button.primary:enabled').first().click()
      await page.getByTitle(/meteo/).click()
      await opened(page, '#/demo/recording/meteo', true)
      await page.waitForSelector('.guide section')
    },
  },
  { name: 'search', hash: '#/demo/search' },
  {
    name: 'search_completion',
    hash: '#/demo/search',
    then: async (page) => {
      for (let i = 0; i < 50 && !(await page.locator('.field [role=option]').count()); ++i) {
        // until the vocabulary is loaded
        await page.locator('.field textarea').fill('gloss = "VANNES" & phase = ')
        await page.keyboard.press('Control+Space')
      }
    },
  },
  { name: 'search_fault', hash: '#/demo/search?q=' + encodeURIComponent('gloss = "VANNES" &\n  phase = strok') },
  { name: 'search_table', hash: '#/demo/search?q=' + encodeURIComponent('phase = stroke & duration > 500ms'), then: shown },
  { name: 'search_grid', hash: '#/demo/search?view=grid&q=' + encodeURIComponent('phase = stroke & like("villes"@1810..2390)'), body: 'drawn', then: shown },
  { name: 'fault', hash: '#/demo/recording/nobody' },
  { name: 'new_signing', hash: kCompose, then: (page) => composed(page) },
  { name: 'compose_lanes', hash: '#/channels/compose?' + new URLSearchParams({ utterance: kScenario3 }), then: (page) => composed(page, 10.3) },
  { name: 'compose_empty', hash: '#/demo/compose', then: (page) => page.locator('.empty button').first().waitFor() },
  {
    name: 'compose_tokens',
    hash: kCompose,
    then: async (page) => {
      await composed(page)
      await page.locator('.card').nth(1).click()
      await page.locator('aside .token').first().waitFor()
    },
  },
  {
    name: 'compose_compare',
    hash: kCompose,
    then: async (page) => {
      await composed(page)
      await compared(page)
    },
  },
  { name: 'compose_scenario', hash: '#/demo/compose', then: scenario },
  { name: 'import', hash: '#/mine/import', then: chooseFiles },
  {
    name: 'import_report',
    hash: '#/mine/import',
    then: async (page, folder) => {
      await chooseFiles(page, folder)
      await page.locator('.acts .primary').click()
      await page.locator('article').waitFor({ timeout: 120_000 })
      await page.locator('.report').evaluate((report) => report.scrollIntoView())
    },
  },
  { name: 'storage', hash: '#/demo', then: (page) => page.locator('.head button').last().click() },
  {
    name: 'phases',
    hash: '#/demo/phases/meteo',
    then: async (page) => {
      await page.waitForFunction(() => document.querySelector('.bench[data-ready]') && window.signweaveStage?.panes[0]?.seen, null, { timeout: 90_000 })
      for (const key of ['ArrowDown', 'Enter', 'Enter', 'Delete', 'Enter']) await page.keyboard.press(key)
    },
  },
]
function chooseFiles(page, folder) {
  const names = ['meteo.bvh', 'meteo.eaf', 'meteo.face.csv', 'villes.bvh', 'villes.eaf']
  return page.locator('input[type=file]:not([webkitdirectory])').setInputFiles(names.map((name) => join(folder, 'corpus', name)))
}

/** Waits until the composition is loaded, at a moment with the hands up. */
async function composed(page, at = 2) {
  await page.waitForFunction(
    () =>
      document.querySelector('.compose').dataset.busy === 'false' &&
      window.signweaveStage?.panes.length > 0 &&
      window.signweaveStage.panes.every(({ store, seen }) => seen && store.arrived >= store.length),
    null,
    { timeout: 90_000 },
  )
  await page.evaluate((to) => {
    const stage = window.signweaveStage
    stage.transport.pause()
    stage.transport.seek(to)
    stage.touch()
  }, at)
}
async function compared(page) {
  await page.locator('.junction').nth(2).click()
  await composed(page)
  await page.locator('aside select').last().selectOption('sine')
  await page.waitForFunction(() => window.signweaveStage.panes.length === 2, null, { timeout: 90_000 })
  await composed(page, 4.3)
}
async function scenario(page) {
  await page.locator('.empty button').first().click()
  await page.waitForFunction(() => window.signweaveStage?.panes.length === 2, null, { timeout: 90_000 })
  await composed(page, 28.2)
}
/** Waits until the first answers are drawn; then pauses everything. */
async function shown(page) {
  await page.waitForFunction(
    () => window.signweaveStage?.panes[0]?.seen || [...(window.signweaveSheet?.cells.values() ?? [])].filter(({ seen }) => seen).length > 5,
    null,
    { timeout: 90_000 },
  )
  await page.evaluate(() => document.querySelector('.play').click()) // at once: during playback, software rendering leaves no time for a mouse
}

mkdirSync(out, { recursive: true })
await withServer(
  site,
  async (address, folder) => {
    for (const [theme, language, size, label] of [
      ['dark', 'en', kDesk, 'dark'],
      ['light', 'fr', kDesk, 'light_fr'],
      ['dark', 'fr', kPhone, 'phone'],
    ]) {
      await withBrowser(
        async (context) => {
          for (const view of kViews) {
            const name = `${view.name}_${label}`
            if (only && !new RegExp(only).test(name)) continue
            const page = await context.newPage()
            if (view.still) await page.emulateMedia({ reducedMotion: 'reduce' })
            await page.addInitScript((body) => localStorage.setItem('signweave.body', body), view.body ?? 'woman')
            if (!/search/.test(view.name)) await page.addInitScript(likeACard)
            await page.addInitScript(() => {
              // no view sees another's progress
              if (!sessionStorage.begun) ['guide', 'study.demo'].forEach((key) => localStorage.removeItem(`signweave.${key}`))
              sessionStorage.begun = '1'
            })
            await page.goto(`${address}/${view.hash}`, { timeout: 120_000 })
            await opened(page, view.hash, true)
            if (view.seek !== undefined)
              await page.evaluate((to) => {
                const { transport } = window.signweaveStage
                transport.pause()
                transport.seek(to)
                window.signweaveStage.touch()
              }, view.seek)
            for (const key of view.keys ?? []) await page.keyboard.press(key)
            await view.then?.(page, folder)
            await drawn(page)
            await page.screenshot({ path: `${out}/${name}.png`, fullPage: view.tall })
            console.log(`${out}/${name}.png`)
            await page.close()
          }
        },
        { viewport: size, colorScheme: theme, locale: language === 'fr' ? 'fr-FR' : 'en-GB' },
      )
    }
  },
  linkVideo,
  { mine: true, channels: true },
)
