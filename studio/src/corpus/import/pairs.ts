import type { FilePart } from '../../api/corpus_answers'

/** Files that make one recording, by the names that they are sent under. */
export interface Pair {
  readonly motion: string | null
  readonly annotation: string | null
  readonly face: string | null
  readonly signer: string
  /** Annotation time of frame 0, and the motion's time of the face's first row, in ms, as a table tells them. */
  readonly offset?: string
  readonly faceOffset?: string
  /** What the recording is called, where a table tells it. */
  readonly name?: string
}
export type Files = Pick<Pair, FilePart>

/** What a recording is known by while it is corrected. */
export const keyOf = (files: Files): string => files.motion ?? files.annotation ?? ''

/** A file's name without its ending: what a recording made of it is called. */
export type Stem = (name: string) => string

/**
 * With another file as a part of one recording, or none. A motion belongs to one recording, and so does a face; an annotation may serve several motions. What
 * belongs to nothing then becomes a recording of its own, unless another has that name: it is left out then.
 */
export function paired(pairs: readonly Pair[], key: string, part: FilePart, file: string | null, stem: Stem): readonly Pair[] {
  const one = pairs.find((pair) => keyOf(pair) === key)
  if (!one || one[part] === file) return pairs
  let rest = pairs.filter((pair) => pair !== one)
  let changed: Pair = { ...one, [part]: file }
  if (part === 'motion' && file !== null) {
    // That motion's own recording is this one from now on.
    const other = rest.find(({ motion }) => motion === file)
    rest = rest.filter((pair) => pair !== other)
    changed = { ...changed, face: other?.face ?? null }
  } else if (part === 'motion') changed = { ...changed, face: null }
  else if (part === 'face' && file !== null) rest = rest.map((pair) => (pair.face === file ? { ...pair, face: null } : pair))
  else if (file !== null) rest = rest.filter(({ motion, annotation }) => motion !== null || annotation !== file)
  // A motion that is taken away from the annotation of its name leaves the name to it.
  if (part === 'motion' && file === null && one.motion && changed.annotation && stem(one.motion) === stem(changed.annotation)) {
    return named([...rest, changed].sort(byKey), stem)
  }
  return named(completed([...rest, ...(changed.motion || changed.annotation ? [changed] : [])], pairs), stem)
}
const byKey = (a: Pair, b: Pair) => (keyOf(a) < keyOf(b) ? -1 : 1)

/** What `before` had and no pair has now comes as recordings of its own; faces need a motion, and stay where they lay where they have one. */
function completed(pairs: readonly Pair[], before: readonly Pair[]): readonly Pair[] {
  const has = (part: FilePart, file: string | null) => file === null || pairs.some((pair) => pair[part] === file)
  const alone: Pair[] = []
  for (const { motion, annotation, face, signer } of before) {
    if (!has('motion', motion)) alone.push({ motion, annotation: null, face: has('face', face) ? null : face, signer })
    if (!has('annotation', annotation) && !alone.some((pair) => pair.annotation === annotation)) alone.push({ motion: null, annotation, face: null, signer })
  }
  return [...pairs, ...alone].sort(byKey)
}

/** Without annotations alone that would be called as a recording with motion is: no two can have one name. */
function named(pairs: readonly Pair[], stem: Stem): readonly Pair[] {
  const motions = new Set(pairs.flatMap(({ motion }) => (motion ? [stem(motion)] : [])))
  return pairs.filter(({ motion, annotation }) => motion !== null || !motions.has(stem(annotation!)))
}

/** For files that came or went since: what is gone is in no pair, and what is new belongs to what has the same stem. */
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

/** As the server reads it (docs/formats.md). */
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

/** What is wrong with a table of pairs: a file that was not chosen, or a line that is no pair. */
export interface TableFault {
  readonly line: number
  readonly file?: string
}

/** Reads a table of pairs. Its paths stand for the files of those names: `names` are those that were chosen. */
export function readTable(text: string, names: ReadonlySet<string>): { readonly pairs: readonly Pair[]; readonly faults: readonly TableFault[] } {
  const pairs: Pair[] = [],
    faults: TableFault[] = []
  const beside = (motion: string) => `${motion.replace(/\.[^.]*$/, '')}.face.csv`
  for (const { line, fields } of rowsOf(text)) {
    const [motion = '', annotation = '', signer = '', offset = '', face = '', faceOffset = '', name = ''] = fields.map((field) => field.trim())
    if (pairs.length === 0 && motion.toLowerCase() === 'motion') continue
    const file = (path: string) => path.replaceAll('\\', '/').split('/').at(-1)! || null
    const files = { motion: file(motion), annotation: file(annotation), face: face === '-' ? null : file(face) }
    // Nothing said, what lies beside the motion is its face, as the server has it.
    if (files.motion && !face && names.has(beside(files.motion))) files.face = beside(files.motion)
    const missing = Object.values(files).find((name) => name !== null && !names.has(name))
    if (missing) faults.push({ line, file: missing })
    else if (!files.motion && !files.annotation) faults.push({ line })
    else pairs.push({ ...files, signer, offset: offset || undefined, faceOffset: faceOffset || undefined, name: name || undefined })
  }
  return { pairs, faults }
}

/** Rows of CSV (RFC 4180) with the line that each begins on; empty ones are left out. */
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
