import { mkdtempSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { chromium } from 'playwright-core'
import { watchBrowser } from './evidence.mjs'

/** Debian's Chromium with software rendering and without network traffic of its own. */
const kFlags = [
  '--no-sandbox',
  '--disable-gpu',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
]

/** Runs `work` with a separate browser, and cleans up afterwards. */
export async function withBrowser(work, options = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'signweave-browser-'))
  const context = await chromium.launchPersistentContext(folder, {
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    headless: true,
    args: kFlags,
    viewport: { width: 1280, height: 720 },
    ...options,
  })
  // Software rendering on a busy machine is slow.
  context.setDefaultTimeout(90_000)
  const unwatch = watchBrowser(context)
  try {
    return await work(context)
  } finally {
    unwatch()
    await context.close()
    rmSync(folder, { recursive: true, force: true })
  }
}
