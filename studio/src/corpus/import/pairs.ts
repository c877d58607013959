import type { FilePart } from '../../api/types'

/** The files of one recording, by the names under which they are sent. */
export interface Pair {
  readonly motion: string | null
  readonly annotation: string | null
  readonly face: string | null
  readonly signer: string
  /** Annotation time of frame 0, and the motion's time of the face's first row, in ms, as given in a table. */
  readonly offset?: string
  readonly faceOffset?: string
  /** The name of the recording, if given in a table. */
  readonly name?: string
}
export type Files = Pick<Pair, FilePart>

/** Returns the key that identifies a recording during corrections. */
export const keyOf = (files: Files): string => files.motion ?? files.annotation ?? ''

/** Returns a file's name without its extension: the name of a recording built from it. */
export type Stem = (name: string) => string

/**
 * Sets another file as a part of one recording; null removes it. A motion belongs to one recording, and so does a face; an annotation may belong to several
 * motions. Files that then belong to nothing become recordings of their own, unless another has that name, in which case they are left out.
 */
export function paired(pairs: readonly Pair[], key: string, part: FilePart, file: string | null, stem: Stem): readonly Pair[] {
  const one = pairs.find((pair) => keyOf(pair) === key)
  if (!one || one[part] === file) return pairs
  let rest = pairs.filter((pair) => pair !== one)
  let changed: Pair = { ...one, [part]: file }
  if (part === 'motion' && file !== null) {
    // This recording replaces that motion's own recording.
    const other = rest.find(({ motion }) => motion === file)
    rest = rest.filter((pair) => pair !== other)
    changed = { ...changed, face: other?.face ?? null }
  } else if (part === 'motion') changed = { ...changed, face: null }
  else if (part === 'face' && file !== null) rest = rest.map((pair) => (pair.face === file ? { ...pair, face: null } : pair))
  else if (file !== null) rest = rest.filter(({ motion, annotation }) => motion !== null || annotation !== file)
  // A motion removed from the annotation with its name leaves the name to the annotation.
  if (part === 'motion' && file === null && one.motion && changed.annotation && stem(one.motion) === stem(changed.annotation)) {
    return named([...rest, changed].sort(byKey), stem)
  }
  return named(completed([...rest, ...(changed.motion || changed.annotation ? [changed] : [])], pairs), stem)
}
const byKey = (a: Pair, b: Pair) => (keyOf(a) < keyOf(b) ? -1 : 1)

/** Adds recordings for files that were in `before` and are in no pair now; a face needs a motion, and stays with its previous one if there is one. */
function completed(pairs: readonly Pair[], before: readonly Pair[]): readonly Pair[] {
  const has = (part: FilePart, file: string | null) => file === null || pairs.some((pair) => pair[part] === file)
  const alone: Pair[] = []
  for (const { motion, annotation, face, signer } of before) {
    if (!has('motion', motion)) alone.push({ motion, annotation: null, face: has('face', face) ? null : face, signer })
    if (!has('annotation', annotation) && !alone.some((pair) => pair.annotation === annotation)) alone.push({ motion: null, annotation, face: null, signer })
  }
  return [...pairs, ...alone].sort(byKey)
}

/** Removes annotation-only recordings with the name of a recording that has motion: names are unique. */
function named(pairs: readonly Pair[], stem: Stem): readonly Pair[] {
  const motions = new Set(pairs.flatMap(({ motion }) => (motion ? [stem(motion)] : [])))
  return pairs.filter(({ motion, annotation }) => motion !== null || !motions.has(stem(annotation!)))
}

/** Updates pairs for files added or removed since: removed files leave their pairs, and new files are matched by their stem. */
export function extended(pairs: readonly Pair[], names: ReadonlySet<string>, all: Readonly<Record<FilePart, readonly string[]>>, stem: Stem): readonly Pair[] {
  const here = (name: string | null) => (name !== null && names.has(name) ? name : null)
  const kept = pairs
    .map((pair) => ({ ...pair, motion: here(pair.motion), annotation: here(pair.annotation), face: here(pair.motion) && here(pair.face) }))
    .filter(({ motion, annotation }) => motion || annotation)
  const isNew = (part: FilePart) => (name: string) => !kept.some((pair) => pair[part] === name)
  const annotations = all.annotation.filter(isNew('annotation')),
    faces = all.face.filter(isNew('face'))
  const like = (list: readonly string[], name: string) => list.find((other) => stem(other) === stem(name)) ?? null
  const motions = all.motion
    .filter(isNew('motion'))
    .map((motion): Pair => ({ motion, annotation: like(annotations, motion), face: like(faces, motion), signer: '' }))
  const alone = annotations
    .filter((name) => !motions.some(({ annotation }) => annotation === name))
    .map((annotation): Pair => ({ motion: null, annotation, face: null, signer: '' }))
  return named([...kept, ...motions, ...alone], stem)
}

/** Returns the table as the server reads it (docs/formats.md). */
export function tableOf(pairs: readonly Pair[]): string {
  const rows = pairs.map(({ motion, annotation, signer, offset, face, faceOffset, name }) => [
    motion,
    annotation,
    signer,
    offset,
    face ?? (motion ? '-' : ''),
    face ? faceOffset : '',
    name,
  ])
  return ['motion,annotation,signer,offset,face,face offset,name', ...rows.map((row) => row.map((field) => quoted(field ?? '')).join(','))].join('\n') + '\n'
}
const quoted = (field: string) => (/[",\r\n]|^\s|\s$/.test(field) ? `"${field.replaceAll('"', '""')}"` : field)

/** A fault in a table of pairs: a file that was not chosen, or a line that is no pair. */
export interface TableFault {
  readonly line: number
  readonly file?: string
}

/** Reads a table of pairs. Its paths refer to files by their names; `names` are the chosen files. */
export function readTable(text: string, names: ReadonlySet<string>): { readonly pairs: readonly Pair[]; readonly faults: readonly TableFault[] } {
  const pairs: Pair[] = [],
    faults: TableFault[] = []
  const faceNextTo = (motion: string) => `${motion.replace(/\.[^.]*$/, '')}.face.csv`
  for (const { line, fields } of rowsOf(text)) {
    const [motion = '', annotation = '', signer = '', offset = '', face = '', faceOffset = '', name = ''] = fields.map((field) => field.trim())
    if (pairs.length === 0 && motion.toLowerCase() === 'motion') continue
    const file = (path: string) => path.replaceAll('\\', '/').split('/').at(-1)! || null
    const files = { motion: file(motion), annotation: file(annotation), face: face === '-' ? null : file(face) }
    // By default the file next to the motion is its face, as on the server.
    if (files.motion && !face && names.has(faceNextTo(files.motion))) files.face = faceNextTo(files.motion)
    const missing = Object.values(files).find((name) => name !== null && !names.has(name))
    if (missing) faults.push({ line, file: missing })
    else if (!files.motion && !files.annotation) faults.push({ line })
    else pairs.push({ ...files, signer, offset: offset || undefined, faceOffset: faceOffset || undefined, name: name || undefined })
  }
  return { pairs, faults }
}

/** Returns the rows of a CSV (RFC 4180) with the line at which each begins; empty rows are skipped. */
function rowsOf(text: string): readonly { readonly line: number; readonly fields: readonly string[] }[] {
  const rows: { line: number; fields: string[] }[] = []
  let line = 1,
    at = text.startsWith('\ufeff') ? 1 : 0
  while (at < text.length) {
    const row = { line, fields: [''] }
    let inQuotes = false
    for (; at < text.length; ++at) {
      const c = text[at],
        last = row.fields.length - 1
      if (c === '\n') ++line
      if (inQuotes) {
        if (c !== '"') row.fields[last] += c
        else if (text[at + 1] === '"') row.fields[last] += text[++at]
        else inQuotes = false
      } else if (c === '"' && row.fields[last] === '') inQuotes = true
      else if (c === ',') row.fields.push('')
      else if (c === '\n') break
      else if (c !== '\r') row.fields[last] += c
    }
    ++at
    if (row.fields.length > 1 || row.fields[0].trim()) rows.push(row)
  }
  return rows
}
