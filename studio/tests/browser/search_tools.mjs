// Helpers shared by the tests of the search.
import { readFileSync } from 'node:fs'
import { page, visit } from './suite.mjs'

export const kAll = 'gloss =~ /.*/'
export const addressOf = (text, more = '') => `#/demo/search?q=${encodeURIComponent(text)}${more}`
export const button = (name, options = { exact: true }) => page.getByRole('button', { name, ...options })
export const field = () => page.locator('.field textarea')
export const list = () => page.getByRole('grid', { name: 'Answers' })
export const status = () => page.locator('[data-status]')

/** Waits until a query has its answers. */
export async function answered(count) {
  await page.waitForFunction((n) => {
    const line = document.querySelector('[data-status=answered]')
    return line && (n === undefined || line.textContent.trim().replace(/,/g, '').startsWith(`${n} answer`))
  }, count)
}
/** Visits a query. Nothing plays unless the test is about playback: software rendering is slow. */
export async function asked(text, count, { more, still = true } = {}) {
  await visit(addressOf(text, more), { still })
  await answered(count)
}
export const run = async (text, count) => {
  await field().fill(text)
  await page.keyboard.press('Enter')
  await answered(count)
}
export const saved = async (work) => {
  const [download] = await Promise.all([page.waitForEvent('download'), work()])
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) }
}
