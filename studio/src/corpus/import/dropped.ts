import type { Picked } from './file_list'

/** Returns all dropped files, with the contents of folders. Must be called within the event itself: its items are gone afterwards. */
export function dropped(transfer: DataTransfer): Promise<readonly Picked[]> {
  const entries = [...transfer.items].flatMap((item) => (item.kind === 'file' ? [item.webkitGetAsEntry?.() ?? item.getAsFile()] : []))
  return Promise.all(
    entries.map(async (entry) => {
      if (!entry) return []
      return entry instanceof File ? [{ file: entry, folder: '' }] : walked(entry, '')
    }),
  ).then((lists) => lists.flat())
}

/** Returns the files of an input, with their folders if the input selects a folder. */
export function chosen(files: Iterable<File>): readonly Picked[] {
  return [...files].map((file) => ({ file, folder: file.webkitRelativePath.split('/').slice(0, -1).join('/') }))
}

async function walked(entry: FileSystemEntry, folder: string): Promise<readonly Picked[]> {
  if (entry.isFile) {
    const file = await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject))
    return [{ file, folder }]
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader()
  const within = folder ? `${folder}/${entry.name}` : entry.name
  const found: Picked[] = []
  // Browsers return a folder's entries by the hundred, until a call returns none.
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject))
    if (some.length === 0) return found
    for (const one of some) found.push(...(await walked(one, within)))
  }
}
