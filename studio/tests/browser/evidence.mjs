import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { join, resolve } from 'node:path'

/** The folder for evidence of failed tests. */
export const kFailures = resolve(process.env.SIGNWEAVE_FAILURES ?? join(import.meta.dirname, '../../../build/browser-failures'))

const contexts = new Set()
const logs = new Set()
/** The logs of servers that ended during the test. */
let ended = []
let lines = []

const note = (page, text) => lines.push(`${new Date().toISOString()} ${page.url()} ${text}`)

/** Records the console of every page of a browser until the returned function is called. */
export function watchBrowser(context) {
  contexts.add(context)
  context.on('page', (page) => {
    page.on('console', (message) => note(page, `${message.type()}: ${message.text()}`))
    page.on('pageerror', (error) => note(page, `threw: ${error.stack ?? error.message}`))
    page.on('requestfailed', (request) => note(page, `failed: ${request.method()} ${request.url()} ${request.failure()?.errorText}`))
    page.on('response', (response) => {
      if (response.status() >= 400) note(page, `answered ${response.status()}: ${response.request().method()} ${response.url()}`)
    })
    page.on('crash', () => note(page, 'crashed'))
  })
  return () => contexts.delete(context)
}

/** Saves the log of a server for the test that fails while it runs or after it; call the returned function when it has ended. */
export function watchLog(path) {
  logs.add(path)
  return () => {
    logs.delete(path)
    ended.push(readFileSync(path))
  }
}

export const folderOf = (name) => join(kFailures, name.replace(/[^\p{L}\p{N}]+/gu, '-').slice(0, 100))

/** Starts a test: evidence of earlier runs under its name is removed. */
export function beginEvidence(name) {
  lines = []
  ended = []
  rmSync(folderOf(name), { recursive: true, force: true })
}

/** Saves a picture and the text of every open page, their console output, and the logs of the servers. */
export async function leaveEvidence(name, fault) {
  const folder = folderOf(name)
  mkdirSync(folder, { recursive: true })
  writeFileSync(join(folder, 'fault.txt'), `${name}\n${fault?.stack ?? fault}\n`)
  writeFileSync(join(folder, 'console.txt'), lines.map((line) => `${line}\n`).join(''))
  const said = [...[...logs].map((log) => readFileSync(log)), ...ended]
  said.forEach((log, i) => writeFileSync(join(folder, `server${i || ''}.log`), log))
  const pages = [...contexts].flatMap((context) => context.pages()).filter((page) => page.url() !== 'about:blank')
  for (const [i, page] of pages.entries()) {
    // The page may be busy or gone: whatever is available is saved.
    await page.screenshot({ path: join(folder, `page${i || ''}.png`), timeout: 30_000 }).catch((error) => note(page, `no picture: ${error.message}`))
    const text = page.content().then((html) => writeFileSync(join(folder, `page${i || ''}.html`), html))
    await inTime(text, 10).catch((error) => note(page, `no text: ${error.message}`))
  }
  writeFileSync(join(folder, 'console.txt'), lines.map((line) => `${line}\n`).join(''))
}

/** Resolves like the promise, or with an error if that takes longer than the given seconds. */
export async function inTime(promise, seconds) {
  let timer
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Error(`not done after ${seconds} s`)), 1000 * seconds)
  })
  try {
    return await Promise.race([promise, late])
  } finally {
    clearTimeout(timer)
  }
}
