// Helpers shared by the tests of the compose page.
import { readFileSync } from 'node:fs'
import { page, visit } from './suite.mjs'

export const button = (name) => page.getByRole('button', { name, exact: true })
export const field = () => page.getByRole('combobox', { name: 'Glosses in order' })
export const cards = () => page.locator('.card .gloss').allTextContents()
export const pause = () =>
  page.evaluate(() => {
    window.signweaveStage.transport.pause()
  })

/** Waits until the result of a text is on the screen. */
export const shown = (text) =>
  page.waitForFunction((wanted) => {
    const { made, busy } = document.querySelector('.compose')?.dataset ?? {}
    return busy === 'false' && made === wanted && window.signweaveStage?.panes.length > 0
  }, text)
/** Opens the page with an utterance, and pauses playback, which is slow with software rendering. */
export async function compose(utterance, more = {}, options = {}) {
  await visit(`#/demo/compose?${new URLSearchParams({ utterance, ...more })}`, options)
  await shown(utterance)
  await pause()
}
/** Picks an item from a menu of the toolbar. */
export async function pick(menu, name) {
  await button(menu).click()
  await page.locator('.list').getByRole('button', { name }).click()
}
export const saved = async (act) => {
  const [file] = await Promise.all([page.waitForEvent('download', { timeout: 180_000 }), act()])
  return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) }
}
