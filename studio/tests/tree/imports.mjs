import { posix } from 'node:path'
import ts from 'typescript'

const kCode = /\.(ts|js|mjs|svelte)$/
/** The parts of an imported file's name that may be omitted; `./x.svelte` may also be `./x.svelte.ts`. */
const kExtensions = ['', '.ts', '.js', '.mjs']

/** Returns a file's imports within the tree: types, values and dynamic imports. */
function importsOf({ path, text }) {
  const code = path.endsWith('.svelte') ? [...text.matchAll(/<script[^>]*>(.*?)<\/script>/gs)].map(([, script]) => script).join('\n') : text
  return ts
    .preProcessFile(code, true, true)
    .importedFiles.map(({ fileName }) => fileName.replace(/\?.*/, ''))
    .filter((name) => name.startsWith('.'))
    .map((name) => posix.join(posix.dirname(path), name))
    .filter((name) => !name.startsWith('..'))
}

/** Returns the imported files of each code file; missing files are faults. */
export function importGraph(files) {
  const known = new Set(files.map(({ path }) => path))
  const graph = new Map()
  const faults = []
  for (const file of files.filter(({ path }) => kCode.test(path))) {
    const imports = new Set()
    for (const wanted of importsOf(file)) {
      const found = kExtensions.map((extension) => wanted + extension).find((path) => known.has(path))
      if (found) imports.add(found)
      else faults.push(`${file.path} imports ${wanted}, which does not exist`)
    }
    graph.set(file.path, [...imports])
  }
  return { graph, faults }
}

/** Returns import cycles, one fault each: every file is visited once, with the path that led to it. */
export function importCircles(graph) {
  const faults = []
  const done = new Set()
  const trail = []
  const visit = (path) => {
    if (trail.includes(path)) faults.push(`import cycle: ${[...trail.slice(trail.indexOf(path)), path].join(' -> ')}`)
    else if (!done.has(path)) {
      trail.push(path)
      for (const next of graph.get(path) ?? []) visit(next)
      trail.pop()
      done.add(path)
    }
  }
  for (const path of graph.keys()) visit(path)
  return faults
}
