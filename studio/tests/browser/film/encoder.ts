// The page in which scenario_film.mjs encodes its pictures, by the studio's own encoder.
import { Film } from '../../../src/render/film'

let film: Film | undefined
let canvas: OffscreenCanvas | undefined

/** Starts a film of `bits` for each pixel. */
async function begin(width: number, height: number, rate: number, bits: number): Promise<void> {
  canvas = new OffscreenCanvas(width, height)
  film = await Film.of(width, height, rate, bits)
}
/** Adds a picture of that size, given as base64. */
async function add(png: string): Promise<void> {
  const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${png}`)).blob())
  canvas!.getContext('2d', { alpha: false })!.drawImage(picture, 0, 0)
  picture.close()
  await film!.add(canvas!)
}
/** Returns the WebM as base64. */
async function end(): Promise<string> {
  const bytes = new Uint8Array(await film!.end())
  let text = ''
  for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000))
  return btoa(text)
}
Object.assign(window, { filmEncoder: { begin, add, end } })
