// Helpers shared by the tests of import, recordings and phases.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs'
import { dirname, join, resolve } from 'node:path'
import { fileURLToPath } from 'node:url'
import { axeFaults } from './page_tools.mjs'
import { address, folder, page, visit } from './suite.mjs'

export const kRoot = resolve(dirname(fileURLToPath(import.meta.url)), '../../..')
export const kSignweave = join(process.env.SIGNWEAVE_BIN ?? join(kRoot, 'build/release/bin'), 'signweave')
export const kThanks = join(kRoot, '../shared/data/bvh/signon-thanks')
export const button = (name) => page.getByRole('button', { name, exact: true })
export const stored = async (database = 'mine') => (await (await fetch(`${address}/api/databases/${database}`)).json()).recordings
export const storedOne = async (name) => (await fetch(`${address}/api/databases/mine/recordings/${encodeURIComponent(name)}`)).json()
export const annotation = async (name) => (await fetch(`${address}/api/databases/mine/recordings/${encodeURIComponent(name)}/annotation`)).text()

/** Opens the page of an import into `mine`. */
export async function begin() {
  await visit('#/mine/import')
  await page.locator('.drop').waitFor()
  page.on('dialog', (dialog) => dialog.accept())
}
export const choose = (list) => page.locator('input[type=file]:not([webkitdirectory])').setInputFiles(list)
export async function look() {
  await page.getByRole('button', { name: /^(Send and inspect|Send the rest|Inspect again)$/ }).click()
  await page.getByRole('heading', { name: 'What would be stored' }).waitFor()
}
/** Returns a recording in the report. */
export const row = (name) => page.getByRole('row', { name: new RegExp(`Import ${name} `) })
/** Waits until reports match the corrections. */
export const settled = () =>
  page.waitForFunction(() => !/inspecting again/.test(document.querySelector('main').textContent) && !document.querySelector('.acts progress'))

/** Writes files of a recording of the demo's first seconds, under another name; `change` may change the texts. */
export function files(name, { seconds = 8, into = join(folder, 'files'), motion = true, change = (text) => text } = {}) {
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

/** Stores a recording as a program does; `called` is its name if it differs from that of its files. */
export async function store(name, { called, ...more } = {}) {
  const uploads = `${address}/api/databases/mine/uploads`
  const { upload } = await (await fetch(uploads, { method: 'POST' })).json()
  for (const path of files(name, more)) await fetch(`${uploads}/${upload}/files/${path.split('/').at(-1)}`, { method: 'PUT', body: readFileSync(path) })
  if (called) await fetch(`${uploads}/${upload}/files/pairs.csv`, { method: 'PUT', body: `${name}.bvh,${name}.eaf,,,,,"${called}"\n` })
  const body = JSON.stringify(called ? { pairs: 'pairs.csv' } : {})
  const { job } = await (await fetch(`${uploads}/${upload}/import`, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body })).json()
  for (;;) {
    const { state } = await (await fetch(`${address}/api/jobs/${job}`)).json()
    if (state === 'done') return
    if (state === 'failed') throw new Error(`${name} was not stored`)
    await new Promise((resolve) => setTimeout(resolve, 50))
  }
}
/** Removes everything from the database that tests may change. */
export async function empty() {
  for (const { name } of await stored()) await fetch(`${address}/api/databases/mine/recordings/${encodeURIComponent(name)}`, { method: 'DELETE' })
}

/** Returns accessibility faults, and elements wider than the screen; `what` is their prefix. */
export async function faultsOf(what) {
  const wide = await page.evaluate(() =>
    document.scrollingElement.scrollWidth <= innerWidth && document.querySelector('main').scrollWidth <= innerWidth
      ? []
      : [...document.querySelectorAll('main *')]
          .filter((element) => element.getBoundingClientRect().right > innerWidth && !element.closest('.scroll, .rows'))
          .map(({ outerHTML }) => outerHTML.slice(0, 100)),
  )
  return [...(await axeFaults(page)).map((fault) => `${what}: ${fault}`), ...wide.map((element) => `${what} is wider than the screen: ${element}`)]
}
/** The configurations in which everything must be accessible: two, in which each theme, language and size occurs once. */
export const kViewports = [
  ['dark', 'en', 1280, 720],
  ['light', 'fr', 390, 844],
].map(([theme, language, width, height]) => ({
  size: { width, height },
  name: `${theme}, ${language}, ${width} wide`,
  set: () => page.evaluate(([t, l]) => (localStorage.setItem('signweave.theme', t), localStorage.setItem('signweave.language', l)), [theme, language]),
}))
export const asBefore = () =>
  page.evaluate(() => {
    for (const key of ['theme', 'language', 'checker', 'keys', 'review.mine/plain']) localStorage.removeItem(`signweave.${key}`)
  })
