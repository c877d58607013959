const kMost = 160
/** Content that cannot be wrapped: addresses, and SVG paths. */
const kWhole = /https?:\/\/[^\s"'<>)]+|\bd="[^"]*"/g

/** Returns the lines that are too long, one fault each. */
export function longLines(files) {
  return files.flatMap(({ path, text }) =>
    text.split('\n').flatMap((line, i) => {
      const { length } = line.replace(kWhole, '')
      return length > kMost ? [`${path}:${i + 1}: ${length} characters, at most ${kMost}`] : []
    }),
  )
}
