/** VP9's levels: number, maximum luma samples a second, maximum luma samples a frame. */
const kLevels: readonly (readonly [string, number, number])[] = [
  ['10', 829440, 36864],
  ['11', 2764800, 73728],
  ['20', 4608000, 122880],
  ['21', 9216000, 245760],
  ['30', 20736000, 552960],
  ['31', 36864000, 983040],
  ['40', 83558400, 2228224],
  ['41', 160432128, 2228224],
  ['50', 311951360, 8912896],
  ['51', 588251136, 8912896],
  ['52', 1176502272, 8912896],
  ['60', 1176502272, 35651584],
  ['61', 2353004544, 35651584],
]

/** Returns the codec string of WebCodecs and WebM for VP9, profile 0, 8 bits, of the lowest level that permits such a video. */
export function vp9Codec(width: number, height: number, rate: number): string {
  const samples = width * height
  const level = kLevels.find(([, aSecond, aPicture]) => samples * rate <= aSecond && samples <= aPicture)?.[0] ?? '62'
  return `vp09.00.${level}.08`
}
