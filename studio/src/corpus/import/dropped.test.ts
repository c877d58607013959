import { expect, it } from 'vitest'
import { chosen, dropped } from './dropped'

const fileEntry = (name: string) => ({ isFile: true, name, file: (take: (file: File) => void) => take(new File(['x'], name)) })
/** A folder's reader returns a hundred entries per call, as in browsers. */
const folderEntry = (name: string, entries: readonly unknown[]) => ({
  isFile: false,
  name,
  createReader: () => {
    let at = 0
    return { readEntries: (take: (some: unknown[]) => void) => take(entries.slice(at, (at += 100))) }
  },
})
const item = (entry: unknown) => ({ kind: 'file', webkitGetAsEntry: () => entry, getAsFile: () => new File(['x'], 'plain.bvh') })

it('returns files and the contents of folders of any size', async () => {
  const many = Array.from({ length: 250 }, (_, k) => fileEntry(`${k}.bvh`))
  const transfer = {
    items: [item(fileEntry('a.bvh')), item(folderEntry('day', [...many, folderEntry('two', [fileEntry('b.eaf')])])), item(null), { kind: 'string' }],
  } as unknown as DataTransfer
  const all = await dropped(transfer)
  expect(all.length).toBe(253)
  expect([all[0], all[251], all[252]].map(({ file, folder }) => [folder, file.name])).toEqual([
    ['', 'a.bvh'],
    ['day/two', 'b.eaf'],
    ['', 'plain.bvh'],
  ])
})

it('returns the folders of an input', () => {
  const file = Object.assign(new File(['x'], 'a.bvh'), { webkitRelativePath: 'days/one/a.bvh' })
  expect(chosen([file])[0].folder).toBe('days/one')
})
