/** A file in an archive. */
export interface Packed {
  readonly name: string
  readonly bytes: Uint8Array<ArrayBuffer>
}

const kTable = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1
  return c >>> 0
})

/** CRC-32, as defined for ZIP. */
export function crc32(bytes: Uint8Array): number {
  let crc = 0xffffffff
  for (let i = 0; i < bytes.length; ++i) crc = kTable[(crc ^ bytes[i]) & 0xff] ^ (crc >>> 8)
  return (crc ^ 0xffffffff) >>> 0
}

/** Packs files into one archive, uncompressed; names are UTF-8. At most 65535 files, and 4 GB in total. */
export function zipOf(files: readonly Packed[]): Blob {
  const parts: Uint8Array<ArrayBuffer>[] = [],
    directory: Uint8Array<ArrayBuffer>[] = []
  let at = 0
  for (const { name, bytes } of files) {
    const called = new TextEncoder().encode(name),
      crc = crc32(bytes)
    const local = header(0x04034b50, 30, called, crc, bytes.length, 4)
    const central = header(0x02014b50, 46, called, crc, bytes.length, 6)
    new DataView(central.buffer).setUint32(42, at, true)
    parts.push(local, bytes)
    directory.push(central)
    at += local.length + bytes.length
  }
  const size = directory.reduce((sum, { length }) => sum + length, 0)
  const end = new DataView(new ArrayBuffer(22))
  end.setUint32(0, 0x06054b50, true)
  end.setUint16(8, files.length, true)
  end.setUint16(10, files.length, true)
  end.setUint32(12, size, true)
  end.setUint32(16, at, true)
  return new Blob([...parts, ...directory, new Uint8Array(end.buffer)], { type: 'application/zip' })
}

/** Writes the header before a file, or that in the directory; `fields` is where their common fields begin. */
function header(mark: number, length: number, name: Uint8Array, crc: number, size: number, fields: number): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(length + name.length),
    view = new DataView(bytes.buffer)
  view.setUint32(0, mark, true)
  if (fields === 6) view.setUint16(4, 20, true)
  view.setUint16(fields, 20, true)
  view.setUint16(fields + 2, 0x0800, true) // names are UTF-8
  view.setUint16(fields + 8, 0x21, true) // 1 January 1980: the same files produce the same archive
  view.setUint32(fields + 10, crc, true)
  view.setUint32(fields + 14, size, true)
  view.setUint32(fields + 18, size, true)
  view.setUint16(fields + 22, name.length, true)
  bytes.set(name, length)
  return bytes
}
