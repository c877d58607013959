import type { FileFormat } from '../../api/schema'
import { isRefusal, kindOf, stemOf, type FileKind, type Refusal } from './file_kinds'

/** A chosen file, and its folders, separated by `/`. */
export interface Picked {
  readonly file: File
  readonly folder: string
}
/** A file of the list. `name` is the name under which it is sent. */
export interface Listed extends Picked {
  readonly id: number
  readonly name: string
  readonly kind: FileKind | Refusal
  /** Another file has the same name: only one can be sent. */
  readonly clash: boolean
}
export interface FileList {
  readonly files: readonly Listed[]
  readonly next: number
  /** The number of hidden files in folders that were skipped. */ readonly hidden: number
}

export const kNoFiles: FileList = { files: [], next: 1, hidden: 0 }

/** Adds files. A file chosen again from the same folder replaces the previous one; hidden files in folders are skipped. */
export function added(list: FileList, more: readonly Picked[], formats: readonly FileFormat[]): FileList {
  const seen = more.filter(({ file, folder }) => !(folder && file.name.startsWith('.')))
  const again = (one: Picked) => seen.some(({ file, folder }) => folder === one.folder && file.name === one.file.name)
  let { next } = list
  const fresh = seen.map((one) => ({ ...one, id: next++, name: one.file.name }))
  return classified({ files: [...list.files.filter((one) => !again(one)), ...fresh], next, hidden: list.hidden + more.length - seen.length }, formats)
}

export function without(list: FileList, ids: readonly number[], formats: readonly FileFormat[]): FileList {
  return classified({ ...list, files: list.files.filter(({ id }) => !ids.includes(id)) }, formats)
}

/** Prefixes clashing file names with their folder's name, and also files with the same stem in the same folder, because they belong together. */
export function withFolderNames(list: FileList, formats: readonly FileFormat[]): FileList {
  const stems = new Set(list.files.filter(({ clash }) => clash).map(({ name }) => stemOf(name, formats)))
  const renamed = list.files.map((one) => {
    if (!one.folder || !stems.has(stemOf(one.name, formats)) || one.name !== one.file.name) return one
    return { ...one, name: `${one.folder.replaceAll('/', '_')}_${one.file.name}` }
  })
  return classified({ ...list, files: renamed }, formats)
}

/** Returns the files to send. */
export function sendable(list: FileList): readonly Listed[] {
  return list.files.filter(({ kind, clash }) => !isRefusal(kind) && !clash && kind !== 'pairs' && kind !== 'rig')
}
export const bytesOf = (files: readonly Listed[]) => files.reduce((sum, { file }) => sum + file.size, 0)

type Unclassified = Omit<Listed, 'kind' | 'clash'>
function classified(
  list: { readonly files: readonly Unclassified[]; readonly next: number; readonly hidden: number },
  formats: readonly FileFormat[],
): FileList {
  const names = list.files.map(({ name }) => name)
  const counts = new Map<string, number>()
  for (const name of names) counts.set(name, (counts.get(name) ?? 0) + 1)
  const files = list.files.map((one) => ({ ...one, kind: kindOf(one.name, formats, names), clash: counts.get(one.name)! > 1 }))
  return { ...list, files: files.sort((a, b) => (a.folder === b.folder ? compare(a.name, b.name) : compare(a.folder, b.folder))) }
}
const compare = (a: string, b: string) => (a < b ? -1 : a > b ? 1 : 0)
