import type { FileFormat } from '../../api/schema'

/** The role of a file in an import. A companion is read together with another file; a table of pairs and a mapping file are read here, and not sent. */
export type FileKind = 'motion' | 'skeleton' | 'annotation' | 'face' | 'companion' | 'pairs' | 'rig'
/** Why a file cannot be sent. */
export type Refusal = 'extension' | 'film' | 'name'

const kKinds: Readonly<Record<string, FileKind>> = {
  '.bvh': 'motion',
  '.amc': 'motion',
  '.fbx': 'motion',
  '.glb': 'motion',
  '.gltf': 'motion',
  '.asf': 'skeleton',
  '.eaf': 'annotation',
  '.anvil': 'annotation',
  '.face.csv': 'face',
}
/** Files referenced by others: buffers of glTF, specifications of ANVIL. */
const kCompanions: Readonly<Record<string, string>> = { '.bin': '.gltf', '.xml': '.anvil' }
const kFilms = /\.(mp4|m4v|mov|avi|mpe?g|mkv|webm|wav|mp3)$/i

/** Returns the longest extension that the server knows: `.face.csv` before `.csv`. A hidden file has none. */
export function extensionOf(name: string, formats: readonly FileFormat[]): FileFormat | undefined {
  const lower = name.toLowerCase()
  let best: FileFormat | undefined
  for (const format of formats) {
    if (lower.length > format.extension.length && lower.endsWith(format.extension) && (!best || format.extension.length > best.extension.length)) best = format
  }
  return best
}

/** Returns the name of the recording built from this file: the file name without the extension. */
export function stemOf(name: string, formats: readonly FileFormat[]): string {
  const format = extensionOf(name, formats)
  return format ? name.slice(0, -format.extension.length) : name.replace(/\.[^.]*$/, '')
}

/** Returns the extensions that can be imported, for a file dialog. */
export function readableExtensions(formats: readonly FileFormat[]): readonly string[] {
  return formats.filter(({ reads }) => reads).map(({ extension }) => extension)
}

/** Returns the kind of a file, or why it cannot be sent. `names` are those of all files, because some are read together. */
export function kindOf(name: string, formats: readonly FileFormat[], names: readonly string[]): FileKind | Refusal {
  if (!isPlain(name)) return 'name'
  const format = extensionOf(name, formats)
  if (format?.reads) return kKinds[format.extension] ?? 'motion'
  const lower = name.toLowerCase(),
    dot = lower.lastIndexOf('.'),
    extension = dot > 0 ? lower.slice(dot) : ''
  const partner = kCompanions[extension]
  if (partner && names.some((other) => other.toLowerCase().endsWith(partner))) return 'companion'
  if (extension === '.csv' && !/\.rotations\.csv$/.test(lower)) return 'pairs'
  if (extension === '.rig') return 'rig'
  return kFilms.test(lower) ? 'film' : 'extension'
}

export const isRefusal = (kind: FileKind | Refusal): kind is Refusal => kind === 'extension' || kind === 'film' || kind === 'name'

/** The server's rule for uploaded files: no folders, no ':', no leading dot, at most 200 bytes. */
export function isPlain(name: string): boolean {
  // eslint-disable-next-line no-control-regex -- control characters are what the pattern rejects
  return name !== '' && new TextEncoder().encode(name).length <= 200 && !/^\.|[/\\:\u0000-\u001f\u007f]/.test(name)
}
