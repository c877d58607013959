import { readdirSync, readFileSync } from 'node:fs'
import { join, relative } from 'node:path'

const kNotOurs = new Set(['node_modules', 'dist'])

/** Returns every hand-written file below `root`, with its text. Paths are relative to `root`, in alphabetical order. */
export function filesBelow(root) {
  const found = []
  const walk = (folder) => {
    for (const entry of readdirSync(folder, { withFileTypes: true })) {
      const path = join(folder, entry.name)
      if (entry.isDirectory() && !kNotOurs.has(entry.name)) walk(path)
      else if (entry.isFile() && entry.name !== 'package-lock.json') found.push({ path: relative(root, path), text: readFileSync(path, 'utf8') })
    }
  }
  walk(root)
  return found.sort((a, b) => (a.path < b.path ? -1 : 1))
}
