import type { Declarations } from '../motion/declarations'
import { en, type Text } from '../text/en'

/** Returns the parts of the caption of every frame: the recordings' declarations, and what is not as captured. */
export function captionOf(declarations: Declarations, hasFace: boolean, notes: readonly string[] = [], text: Text = en): readonly string[] {
  return [...new Set([...Object.values(declarations).map(String), ...(hasFace ? [] : [text.neutralFace]), ...notes])]
}

/** Breaks words into lines of at most `width`, as `measure` measures them; parts stay on one line if possible. */
export function linesOf(parts: readonly string[], width: number, measure: (text: string) => number): string[] {
  const lines: string[] = []
  let line = ''
  const add = (text: string, between: string) => {
    const longer = line ? line + between + text : text
    if (measure(longer) <= width) return void (line = longer)
    if (line) lines.push(line)
    line = text
  }
  for (const part of parts) {
    if (measure(part) <= width) add(part, '  ·  ')
    else part.split(/\s+/).forEach((word, i) => add(word, i === 0 ? '  ·  ' : ' '))
  }
  return line ? [...lines, line] : lines
}

/** The caption of a frame, drawn once. */
export interface Caption {
  readonly picture: OffscreenCanvas
  readonly height: number
}

/** Draws a caption for frames of this size; undefined if there is no text. */
export function drawCaption(parts: readonly string[], width: number, height: number): Caption | undefined {
  if (parts.length === 0) return undefined
  const size = Math.max(11, Math.round(0.029 * Math.min(height, (9 / 16) * width)))
  const font = `600 ${size}px system-ui, 'DejaVu Sans', sans-serif`
  const pad = Math.round(0.6 * size),
    step = Math.round(1.3 * size),
    mark = Math.round(1.5 * size)
  const ruler = new OffscreenCanvas(1, 1).getContext('2d')!
  ruler.font = font
  const lines = linesOf(parts, width - 2 * pad - mark, (text) => ruler.measureText(text).width)
  const picture = new OffscreenCanvas(width, lines.length * step + pad)
  const context = picture.getContext('2d')!
  context.fillStyle = '#12161b'
  context.fillRect(0, 0, picture.width, picture.height)
  context.fillStyle = '#ffb454'
  context.fillRect(0, 0, picture.width, Math.max(1, Math.round(size / 10)))
  context.font = font
  context.textBaseline = 'middle'
  const widest = Math.max(...lines.map((line) => context.measureText(line).width))
  const left = Math.max(pad, Math.round((width - widest - mark) / 2))
  triangle(context, left, pad / 2 + step / 2, size)
  context.fillStyle = '#ffd9a3'
  lines.forEach((line, i) => context.fillText(line, left + mark, pad / 2 + (i + 0.5) * step + size / 20))
  return { picture, height: picture.height }
}

/** Draws a warning triangle with its middle at (left + size / 2, middle). */
function triangle(context: OffscreenCanvasRenderingContext2D, left: number, middle: number, size: number): void {
  context.fillStyle = '#ffb454'
  context.beginPath()
  context.moveTo(left + size / 2, middle - 0.5 * size)
  context.lineTo(left + 1.08 * size, middle + 0.42 * size)
  context.lineTo(left - 0.08 * size, middle + 0.42 * size)
  context.closePath()
  context.fill()
  context.fillStyle = '#12161b'
  context.fillRect(left + 0.44 * size, middle - 0.2 * size, 0.12 * size, 0.32 * size)
  context.fillRect(left + 0.44 * size, middle + 0.2 * size, 0.12 * size, 0.12 * size)
}
