import { expect, it } from 'vitest'
import { formatAnswer as row } from '../../api/test_answers'
import { kindOf, readableExtensions, stemOf } from './file_kinds'
import { added, bytesOf, kNoFiles, sendable, withFolderNames, without } from './file_list'

const kFormats = [row('.bvh', true), row('.gltf', true), row('.eaf', true), row('.anvil', true), row('.csv', false), row('.face.csv', true), row('.svg', false)]
const picked = (path: string, text = 'x') => ({ file: new File([text], path.split('/').at(-1)!), folder: path.split('/').slice(0, -1).join('/') })
const names = (list: { files: readonly { name: string }[] }) => list.files.map(({ name }) => name)

it('determines the kinds of files, and rejects those that the server cannot read', () => {
  const all = ['walk.bvh', 'walk.gltf', 'walk.bin']
  const kinds = ['walk.BVH', 'walk.eaf', 'walk.face.csv', 'pairs.csv', 'map.rig', 'walk.bin', 'x.xml', 'walk.mp4', 'walk.txt', '.bvh', 'a:b.bvh', 'walk.svg']
  expect(kinds.map((name) => kindOf(name, kFormats, all))).toEqual([
    'motion',
    'annotation',
    'face',
    'pairs',
    'rig',
    'companion',
    'extension',
    'film',
    'extension',
    'name',
    'name',
    'extension',
  ])
  expect(kindOf('walk.bin', kFormats, ['walk.bin'])).toBe('extension')
  expect(kindOf(`${'é'.repeat(99)}.bvh`, kFormats, [])).toBe('name')
  expect(stemOf('walk.face.csv', kFormats)).toBe('walk')
  expect(readableExtensions(kFormats)).toEqual(['.bvh', '.gltf', '.eaf', '.anvil', '.face.csv'])
})

it('adds files once, and skips hidden files in folders', () => {
  const once = added(kNoFiles, [picked('day/a.bvh'), picked('day/.DS_Store'), picked('b.eaf')], kFormats)
  const twice = added(once, [picked('day/a.bvh', 'longer')], kFormats)
  expect(names(twice)).toEqual(['b.eaf', 'a.bvh'])
  expect([twice.hidden, bytesOf(sendable(twice))]).toEqual([1, 7])
  expect(names(without(twice, [twice.files[1].id], kFormats))).toEqual(['b.eaf'])
})

it('sends no two files of one name, unless prefixed with their folders', () => {
  const list = added(
    kNoFiles,
    ['one/a.bvh', 'one/a.eaf', 'two/a.bvh', 'two/b.bvh', 'c.bvh'].map((path) => picked(path)),
    kFormats,
  )
  expect(list.files.filter(({ clash }) => clash).map(({ folder }) => folder)).toEqual(['one', 'two'])
  expect(sendable(list).map(({ name }) => name)).toEqual(['c.bvh', 'a.eaf', 'b.bvh'])
  const renamed = withFolderNames(list, kFormats)
  expect(names(renamed)).toEqual(['c.bvh', 'one_a.bvh', 'one_a.eaf', 'b.bvh', 'two_a.bvh'])
  expect(renamed.files.some(({ clash }) => clash)).toBe(false)
  // A file without a folder keeps its name.
  const root = withFolderNames(added(kNoFiles, [picked('a.bvh'), picked('one/a.bvh')], kFormats), kFormats)
  expect(names(root)).toEqual(['a.bvh', 'one_a.bvh'])
})
