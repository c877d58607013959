import { describe, expect, it } from 'vitest'
import { filesBelow } from './files.mjs'
import { importCircles, importGraph } from './imports.mjs'
import { longLines } from './lines.mjs'
import { strayTests } from './runs.mjs'

const tree = (files) => Object.entries(files).map(([path, text]) => ({ path, text }))
const circles = (files) => importCircles(importGraph(tree(files)).graph)

describe('import cycles', () => {
  it('are found among types, values, components and dynamic imports', () => {
    expect(circles({ 'a.ts': "import type { B } from './sub/b'", 'sub/b.ts': "export * from '../a'" })).toEqual(['import cycle: a.ts -> sub/b.ts -> a.ts'])
    expect(
      circles({ 'A.svelte': "<script lang='ts'>\n  import { b } from './b.svelte'\n</script>", 'b.svelte.ts': "const a = () => import('./A.svelte')" }),
    ).toEqual(['import cycle: A.svelte -> b.svelte.ts -> A.svelte'])
    expect(circles({ 'a.mjs': "import './a.mjs'" })).toEqual(['import cycle: a.mjs -> a.mjs'])
  })
  it('are not reported if two files import a third, or for comments', () => {
    expect(circles({ 'a.ts': "import './b'\nimport './c'", 'b.ts': "import './c'", 'c.ts': "// import './a'\nconst text = 'import \"./b\"'" })).toEqual([])
  })
  it('are searched through every import, so that a missing one is a fault', () => {
    expect(importGraph(tree({ 'a.ts': "import './b'" })).faults).toEqual(['a.ts imports b, which does not exist'])
  })
})

it('finds lines that are too long, except addresses and SVG paths', () => {
  const long = 'x'.repeat(161)
  const files = tree({ 'a.md': `${'é'.repeat(160)}\n${long}`, 'b.ts': `// https://example.org/${long}`, 'c.svg': `<path d="${long}"/>` })
  expect(longLines(files)).toEqual(['a.md:2: 161 characters, at most 160'])
})

describe('a test that no run includes', () => {
  const files = tree({
    'src/a.test.ts': '',
    'src/b.test.mjs': '',
    'tests/browser/one.test.mjs': '',
    'tests/browser/two.test.mjs': '',
    'avatar/package.json': '{"scripts":{"test":"node --test test/c.test.js"}}',
    'avatar/test/c.test.js': '',
    'avatar/test/d.test.js': '',
  })
  it('is found, and so is a suite that is missing or runs twice', () => {
    expect(strayTests(files, { units: ['src/**/*.test.ts'], suites: ['one', 'gone', 'one'] })).toEqual([
      'src/b.test.mjs is in no run',
      'tests/browser/two.test.mjs is in no run',
      'avatar/test/d.test.js is in no run',
      'tests/browser/gone.test.mjs is in a run, but does not exist',
      'tests/browser/one.test.mjs runs twice',
    ])
  })
})

it('reads this tree', () => {
  const paths = filesBelow(new URL('../..', import.meta.url).pathname).map(({ path }) => path)
  expect(paths).toContain('tests/tree/tree.test.mjs')
  expect(paths.some((path) => path.includes('node_modules'))).toBe(false)
})
