// Checks of the whole tree beyond linters: check.mjs [FOLDER]. One line per fault.
import { resolve } from 'node:path'
import { filesBelow } from './files.mjs'
import { importCircles, importGraph } from './imports.mjs'
import { longLines } from './lines.mjs'
import { strayTests } from './runs.mjs'

const files = filesBelow(resolve(process.argv[2] ?? resolve(import.meta.dirname, '../..')))
const { graph, faults } = importGraph(files)
faults.push(...importCircles(graph), ...longLines(files), ...strayTests(files))
for (const fault of faults) console.error(fault)
if (faults.length > 0) process.exitCode = 1
else console.log(`${files.length} files: no import cycles, no overlong lines, no orphaned tests`)
