// One process of browser suites: SITE=… node --test-reporter=./report.mjs --test-reporter-destination=stdout half.mjs NAME… (run.mjs starts it).
import assert from 'node:assert/strict'
import { begin, faults, plainTest } from './suite.mjs'

// When the parent process is interrupted, it does not wait for this one.
process.once('disconnect', () => process.exit(1))
process.channel.unref()

for (const name of process.argv.slice(2)) {
  begin(name)
  await import(`./${name}.test.mjs`)
}
// The other process has its own test of this kind.
begin('pages')
plainTest(`no view threw anything in ${process.argv.slice(2).join(', ')}`, () => assert.deepEqual(faults, []))
