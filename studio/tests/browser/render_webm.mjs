/** EBML elements that the test descends into or reads, by their number. */
const kInto = new Set([0x18538067, 0x1549a966, 0x1654ae6b, 0xae, 0xe0, 0x1f43b675])
const kNames = { 0x4489: 'duration', 0x2ad7b1: 'scale', 0x86: 'codec', 0x23e383: 'frameNs', 0xb0: 'width', 0xba: 'height' }

/** Reads a WebM file of one track: its metadata, and its blocks in the order of the file. Throws if it is invalid. */
export function readWebm(bytes) {
  const film = { blocks: [] }
  let cluster = 0
  const number = (at, length) => Number([...bytes.subarray(at, at + length)].reduce((sum, byte) => (sum << 8n) | BigInt(byte), 0n))
  // The leading zeros of the first byte give the length; for a size, the remaining bits of that byte belong to the number.
  const varying = (at, keep) => {
    const length = Math.clz32(bytes[at]) - 23
    if (length > 8) throw new Error(`no EBML at ${at}`)
    return { length, value: keep ? number(at, length) : number(at, length) - 2 ** (7 * length) }
  }
  const read = (from, to) => {
    for (let at = from; at < to;) {
      const id = varying(at, true),
        size = varying(at + id.length, false)
      const begin = at + id.length + size.length,
        end = begin + size.value
      if (end > to) throw new Error(`the element ${id.value.toString(16)} at ${at} ends at ${end}, after ${to}`)
      if (id.value === 0xe7) cluster = number(begin, size.value)
      else if (id.value === 0xa3)
        film.blocks.push({ ms: cluster + bytes.readInt16BE(begin + 1), key: (bytes[begin + 3] & 0x80) !== 0, data: bytes.subarray(begin + 4, end) })
      else if (id.value === 0x4489) film.duration = size.value === 8 ? bytes.readDoubleBE(begin) : bytes.readFloatBE(begin)
      else if (id.value === 0x86) film.codec = bytes.toString('latin1', begin, end)
      else if (kNames[id.value]) film[kNames[id.value]] = number(begin, size.value)
      else if (kInto.has(id.value)) read(begin, end)
      at = end
    }
  }
  read(0, bytes.length)
  return film
}

/**
 * Decodes every block in a page: each frame's time in µs, its grey values at 32×18, and how many pixels of its last 24 rows are light and warm, like the
 * caption's text.
 */
export async function decoded(page, { blocks }, codec) {
  return page.evaluate(
    async ([rows, name]) => {
      const seen = [],
        canvas = new OffscreenCanvas(32, 18),
        context = canvas.getContext('2d', { willReadFrequently: true })
      const captionOf = (frame) => {
        const { displayWidth: width, displayHeight: height } = frame,
          foot = new OffscreenCanvas(width, 24).getContext('2d', { willReadFrequently: true })
        foot.drawImage(frame, 0, 24 - height)
        const { data } = foot.getImageData(0, 0, width, 24)
        let count = 0
        for (let i = 0; i < data.length; i += 4) if (data[i] > 190 && data[i] - data[i + 2] > 45) ++count
        return count
      }
      const decoder = new VideoDecoder({
        output: (frame) => {
          context.drawImage(frame, 0, 0, 32, 18)
          const { data } = context.getImageData(0, 0, 32, 18)
          seen.push({
            caption: captionOf(frame),
            timestamp: frame.timestamp,
            width: frame.displayWidth,
            height: frame.displayHeight,
            grey: Array.from({ length: 32 * 18 }, (_, i) => (data[4 * i] + data[4 * i + 1] + data[4 * i + 2]) / 3),
          })
          frame.close()
        },
        error: (fault) => {
          throw fault
        },
      })
      decoder.configure({ codec: name })
      for (const { ms, key, base64 } of rows) {
        decoder.decode(
          new EncodedVideoChunk({ type: key ? 'key' : 'delta', timestamp: 1000 * ms, data: Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)) }),
        )
      }
      await decoder.flush()
      return seen
    },
    [blocks.map(({ ms, key, data }) => ({ ms, key, base64: Buffer.from(data).toString('base64') })), codec],
  )
}

/** Analyses an image in a page: its size, the spread of its grey values, and how many pixels of the last `rows` have the text's colour. */
export async function looked(page, png, rows = 30) {
  return page.evaluate(
    async ([base64, count]) => {
      const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob())
      const { width, height } = picture
      const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true })
      context.drawImage(picture, 0, 0)
      const { data } = context.getImageData(0, 0, width, height)
      let sum = 0,
        squares = 0,
        text = 0
      for (let i = 0; i < data.length; i += 4) {
        const grey = (data[i] + data[i + 1] + data[i + 2]) / 3
        sum += grey
        squares += grey * grey
        if (i >= 4 * width * (height - count) && Math.abs(data[i] - 255) + Math.abs(data[i + 1] - 217) + Math.abs(data[i + 2] - 163) < 40) ++text
      }
      const pixels = width * height,
        mean = sum / pixels
      return { width, height, spread: Math.sqrt(squares / pixels - mean * mean), text }
    },
    [png.toString('base64'), rows],
  )
}
