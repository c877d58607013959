// Runs the browser suites in two parallel processes: run.mjs SITE [--main | NAME…]. --main: of every suite only the tests of main paths.
import { fork } from 'node:child_process'
import { existsSync } from 'node:fs'
import { join } from 'node:path'
import { folderOf, kFailures } from './evidence.mjs'
import { kHalves } from './suites.mjs'

const [site, ...words] = process.argv.slice(2)
const main = words[0] === '--main'
const wanted = main ? [] : words
const strange = wanted.filter((name) => !kHalves.flat().includes(name))
if (!site || strange.length > 0) {
  console.error(`no suite ${strange.join(', ')}: there are ${kHalves.flat().join(', ')}`)
  process.exit(2)
}

/** Runs suites in a process, and returns the result of each test. */
function runHalf(names) {
  const results = []
  const child = fork(join(import.meta.dirname, 'half.mjs'), names, {
    execArgv: [`--test-reporter=${join(import.meta.dirname, 'report.mjs')}`, '--test-reporter-destination=stdout'],
    env: { ...process.env, SITE: site, ...(main ? { SIGNWEAVE_MAIN: '1' } : {}) },
  })
  child.on('message', (result) => {
    results.push(result)
    console.log(`${result.fault ? '✖' : '✔'} ${result.name} (${result.seconds.toFixed(1)} s)`)
    if (result.fault) console.log(result.fault.replace(/^/gm, '    '))
  })
  return new Promise((resolve) => {
    child.once('exit', (code, signal) => {
      // A process that fails although no test failed.
      if (code !== 0 && !results.some(({ fault }) => fault))
        results.push({ name: names.join(', '), seconds: 0, fault: `the process ended with ${signal ?? code}` })
      resolve(results)
    })
  })
}

const start = performance.now()
const halves = wanted.length === 0 ? kHalves : [0, 1].map((k) => wanted.filter((_, i) => i % 2 === k)).filter((half) => half.length > 0)
const results = await Promise.all(halves.map(runHalf))
const failed = results.flat().filter(({ fault }) => fault)

console.log('\nseconds of each suite:')
results.forEach((half, i) => {
  const suites = new Map()
  for (const { name, seconds } of half) {
    const suite = name.split(':')[0]
    const { tests = 0, took = 0 } = suites.get(suite) ?? {}
    suites.set(suite, { tests: tests + 1, took: took + seconds })
  }
  for (const [suite, { tests, took }] of suites)
    console.log(`  ${i + 1}  ${suite.padEnd(16)} ${String(tests).padStart(3)} tests ${took.toFixed(1).padStart(7)} s`)
  const whole = half.reduce((sum, { seconds }) => sum + seconds, 0)
  console.log(`  ${i + 1}  ${'all'.padEnd(16)} ${String(half.length).padStart(3)} tests ${whole.toFixed(1).padStart(7)} s`)
})
const count = results.flat().length
console.log(`browser: ${count} tests, ${count - failed.length} passed, ${failed.length} failed, in ${((performance.now() - start) / 1000).toFixed(0)} s`)
if (failed.length > 0 || count === 0) {
  for (const { name } of failed) console.log(`failed: ${name}${existsSync(folderOf(name)) ? `, see ${folderOf(name)}` : ''}`)
  console.log(`evidence of failed tests: pictures, console output and server logs in ${kFailures}`)
  process.exitCode = 1
}
