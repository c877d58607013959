import { describe, expect, it } from 'vitest'
import { filesBelow } from './files.mjs'
import { importCircles, importGraph } from './imports.mjs'
import { longLines } from './lines.mjs'
import { strayTests } from './runs.mjs'

const tree = (files) => Object.entries(files).map(([path, text]) => ({ path, text }))
const circles = (files) => importCircles(importGraph(tree(files)).graph)

describe('circles of imports', () => {
  it('are found among types, values, components and what is fetched later', () => {
    expect(circles({ 'a.ts': "import type { B } from './sub/b'", 'sub/b.ts': "export * from '../a'" })).toEqual(['circle of imports: a.ts -> sub/b.ts -> a.ts'])
    expect(
      circles({ 'A.svelte': "<script lang='ts'>\n  import { b } from './b.svelte'\n</script>", 'b.svelte.ts': "const a = () => import('./A.svelte')" }),
    ).toEqual(['circle of imports: A.svelte -> b.svelte.ts -> A.svelte'])
    expect(circles({ 'a.mjs': "import './a.mjs'" })).toEqual(['circle of imports: a.mjs -> a.mjs'])
  })
  it('are not where two files import a third, or a comment says so', () => {
    expect(circles({ 'a.ts': "import './b'\nimport './c'", 'b.ts': "import './c'", 'c.ts': "// import './a'\nconst text = 'import \"./b\"'" })).toEqual([])
  })
  it('are looked for through every import, so that one that is not there is a fault', () => {
    expect(importGraph(tree({ 'a.ts': "import './b'" })).faults).toEqual(['a.ts imports b, which is not there'])
  })
})

it('finds lines that are too long, but for addresses and outlines', () => {
  const long = 'x'.repeat(161)
  const files = tree({ 'a.md': `${'é'.repeat(160)}\n${long}`, 'b.ts': `// https://example.org/${long}`, 'c.svg': `<path d="${long}"/>` })
  expect(longLines(files)).toEqual(['a.md:2: 161 characters, at most 160'])
})

describe('a test that belongs to no run', () => {
  const files = tree({
    'src/a.test.ts': '',
    'src/b.test.mjs': '',
    'tests/browser/one.test.mjs': '',
    'tests/browser/two.test.mjs': '',
    'avatar/package.json': '{"scripts":{"test":"node --test test/c.test.js"}}',
    'avatar/test/c.test.js': '',
    'avatar/test/d.test.js': '',
  })
  it('is found, and so is a suite that is not there or is run twice', () => {
    expect(strayTests(files, { units: ['src/**/*.test.ts'], suites: ['one', 'gone', 'one'] })).toEqual([
      'src/b.test.mjs belongs to no run',
      'tests/browser/two.test.mjs belongs to no run',
      'avatar/test/d.test.js belongs to no run',
      'tests/browser/gone.test.mjs is to be run, and is not there',
      'tests/browser/one.test.mjs is run twice',
    ])
  })
})

it('reads this tree', () => {
  const paths = filesBelow(new URL('../..', import.meta.url).pathname).map(({ path }) => path)
  expect(paths).toContain('tests/tree/tree.test.mjs')
  expect(paths.some((path) => path.includes('node_modules'))).toBe(false)
})
