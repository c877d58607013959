// Takes a picture of every view: screenshots.mjs SITE OUT_FOLDER [ONLY]. Look at them at full size.
import { mkdirSync } from 'node:fs'
import { withBrowser } from './chromium.mjs'
import { linkVideo, withServer } from './server.mjs'
import { drawn, opened } from './waits.mjs'

const [site, out, only = ''] = process.argv.slice(2)
const kEdit = '#/demo/edit/meteo?replace=BRETAGNE%3DVANNES&replace=DEMAIN%3DMARSEILLE&replace=VENDREDI%3DRENNES&replace=MATIN%232%3DLE%20MANS'
const kDesk = { width: 1280, height: 720 }, kPhone = { width: 390, height: 844 }
const kViews = [
  { name: 'recordings', hash: '#/demo' },
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
  { name: 'two_recordings', hash: '#/demo/recording/meteo?at=2.2&beside=villes' },
  { name: 'scenario_1', hash: kEdit, seek: 29.4, keys: ['+', '+', '+'] },
  { name: 'new_signing', hash: '#/demo/compose' },
  { name: 'signed', hash: '#/demo/sign/' + encodeURIComponent('VANNES MATIN , "LE MANS" PLUIE'), keys: ['Space'], seek: 1.4 },
  { name: 'live', hash: '#/demo/sign/' + encodeURIComponent('VANNES MATIN') + '?pace=live' },
  { name: 'help', hash: '#/demo/recording/meteo?at=2.2', keys: ['?'] },
  { name: 'search', hash: '#/demo/search' },
  { name: 'search_completion', hash: '#/demo/search', then: async (page) => {
    for (let i = 0; i < 50 && !(await page.locator('.field [role=option]').count()); ++i) { // until the vocabulary is there
      await page.locator('.field textarea').fill('gloss = "VANNES" & phase = ')
      await page.keyboard.press('Control+Space')
    }
  } },
  { name: 'search_fault', hash: '#/demo/search?q=' + encodeURIComponent('gloss = "VANNES" &\n  phase = strok') },
  { name: 'search_table', hash: '#/demo/search?q=' + encodeURIComponent('phase = stroke & duration > 500ms'), then: shown },
  { name: 'search_grid', hash: '#/demo/search?view=grid&q=' + encodeURIComponent('phase = stroke & like("villes"@1810..2390)'), body: 'drawn', then: shown },
  { name: 'fault', hash: '#/demo/recording/nobody' },
]

/** Until the first answers are drawn; then nothing plays any more. */
async function shown(page) {
  await page.waitForFunction(() => window.signweaveStage?.panes[0]?.seen || [...(window.signweaveSheet?.cells.values() ?? [])].filter(({ seen }) => seen).length > 5, null, { timeout: 90_000 })
  await page.evaluate(() => document.querySelector('.play').click()) // at once: while it plays, software has no time for a mouse
}

mkdirSync(out, { recursive: true })
await withServer(site, async (address) => {
  for (const [theme, language, size, label] of [['dark', 'en', kDesk, 'dark'], ['light', 'fr', kDesk, 'light_fr'], ['dark', 'fr', kPhone, 'phone']]) {
    await withBrowser(async (context) => {
      for (const view of kViews) {
        const name = `${view.name}_${label}`
        if (only && !new RegExp(only).test(name)) continue
        const page = await context.newPage()
        await page.addInitScript((body) => localStorage.setItem('signweave.body', body), view.body ?? 'woman')
        await page.goto(`${address}/${view.hash}`, { timeout: 120_000 })
        await opened(page, view.hash, true)
        if (view.seek !== undefined) await page.evaluate((to) => { const { transport } = window.signweaveStage; transport.pause(); transport.seek(to); window.signweaveStage.touch() }, view.seek)
        for (const key of view.keys ?? []) await page.keyboard.press(key)
        await view.then?.(page)
        await drawn(page)
        await page.screenshot({ path: `${out}/${name}.png`, fullPage: view.tall })
        console.log(`${out}/${name}.png`)
        await page.close()
      }
    }, { viewport: size, colorScheme: theme, locale: language === 'fr' ? 'fr-FR' : 'en-GB' })
  }
}, linkVideo)
