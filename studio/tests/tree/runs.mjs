import { matchesGlob, posix } from 'node:path'
import { kHalves } from '../browser/suites.mjs'
import kUnits from '../units.json' with { type: 'json' }

/** The files of tests that some run takes: patterns of vitest's, the browser's suites, and what the character's own `npm test` names. */
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

/** Tests that no run takes, suites that are not there, and suites that are run twice: one fault each. */
export function strayTests(files, runs = {}) {
  const { isTaken, browser } = takenTests(files, runs)
  const known = new Set(files.map(({ path }) => path))
  return [
    ...[...known].filter((path) => /\.test\.[^.]+$/.test(path) && !isTaken(path)).map((path) => `${path} belongs to no run`),
    ...browser.filter((path) => !known.has(path)).map((path) => `${path} is to be run, and is not there`),
    ...browser.filter((path, i) => browser.indexOf(path) !== i).map((path) => `${path} is run twice`),
  ]
}
