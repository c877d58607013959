const kMost = 160
/** What cannot be broken: addresses, and the outlines of drawings. */
const kWhole = /https?:\/\/[^\s"'<>)]+|\bd="[^"]*"/g

/** Lines that are too long, one fault each. */
export function longLines(files) {
  return files.flatMap(({ path, text }) =>
    text.split('\n').flatMap((line, i) => {
      const { length } = line.replace(kWhole, '')
      return length > kMost ? [`${path}:${i + 1}: ${length} characters, at most ${kMost}`] : []
    }),
  )
}
