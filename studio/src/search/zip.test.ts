import { expect, it } from 'vitest'
import { crc32, zipOf } from './zip'

const bytes = (text: string) => new TextEncoder().encode(text)

/** Returns the entries of an archive's directory, and the bytes to which they point. */
function read(archive: Uint8Array<ArrayBuffer>) {
  const view = new DataView(archive.buffer),
    end = archive.length - 22
  expect(view.getUint32(end, true)).toBe(0x06054b50)
  const found: { name: string; bytes: Uint8Array }[] = []
  let at = view.getUint32(end + 16, true)
  expect(at + view.getUint32(end + 12, true)).toBe(end)
  for (let i = 0; i < view.getUint16(end + 10, true); ++i) {
    expect(view.getUint32(at, true)).toBe(0x02014b50)
    const size = view.getUint32(at + 24, true),
      length = view.getUint16(at + 28, true),
      local = view.getUint32(at + 42, true)
    expect(view.getUint32(local, true)).toBe(0x04034b50)
    const begin = local + 30 + view.getUint16(local + 26, true)
    const content = archive.subarray(begin, begin + size)
    expect([view.getUint32(at + 16, true), view.getUint32(local + 14, true)]).toEqual([crc32(content), crc32(content)])
    expect(view.getUint16(local + 6, true)).toBe(0x0800)
    found.push({ name: new TextDecoder().decode(archive.subarray(at + 46, at + 46 + length)), bytes: content })
    at += 46 + length
  }
  return found
}

it('computes checksums as in ZIP', () => expect(crc32(bytes('123456789'))).toBe(0xcbf43926))

it('creates an archive whose directory points to every file', async () => {
  const big = new Uint8Array(70_000).map((_, i) => i)
  const files = [
    { name: 'été 1.bvh', bytes: bytes('HIERARCHY') },
    { name: 'b.bin', bytes: big },
  ]
  expect(read(new Uint8Array(await zipOf(files).arrayBuffer()))).toEqual(files)
})
