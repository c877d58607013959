import { matchesGlob, posix } from 'node:path'
import { kHalves } from '../browser/suites.mjs'
import kUnits from '../units.json' with { type: 'json' }

/** Returns the test files included in some run: vitest's patterns, the browser suites, and the files in the character's own `npm test`. */
export function takenTests(files, { units = kUnits, suites = kHalves.flat() } = {}) {
  const manifest = files.find(({ path }) => path === 'avatar/package.json')
  const avatar = manifest
    ? JSON.parse(manifest.text)
        .scripts.test.split(' ')
        .map((word) => posix.join('avatar', word))
    : []
  const browser = suites.map((name) => `tests/browser/${name}.test.mjs`)
  return { isTaken: (path) => units.some((pattern) => matchesGlob(path, pattern)) || browser.includes(path) || avatar.includes(path), browser }
}

/** Returns tests that no run includes, missing suites, and suites that run twice: one fault each. */
export function strayTests(files, runs = {}) {
  const { isTaken, browser } = takenTests(files, runs)
  const known = new Set(files.map(({ path }) => path))
  return [
    ...[...known].filter((path) => /\.test\.[^.]+$/.test(path) && !isTaken(path)).map((path) => `${path} is in no run`),
    ...browser.filter((path) => !known.has(path)).map((path) => `${path} is in a run, but does not exist`),
    ...browser.filter((path, i) => browser.indexOf(path) !== i).map((path) => `${path} runs twice`),
  ]
}
