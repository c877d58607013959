import type { Figure } from './figure'
import { along, type Axes, type Fit } from './view'

export interface Colors {
  readonly left: string
  readonly right: string
  readonly middle: string
  readonly floor: string
  readonly mark: string
}
/** Returns the page's colours at an element. */
export function colorsAt(element: Element): Colors {
  const style = getComputedStyle(element)
  const of = (name: string) => style.getPropertyValue(name).trim()
  return { left: of('--curve-left'), right: of('--curve-right'), middle: of('--ink'), floor: of('--line'), mark: of('--soft') }
}

/** The picture of a posed figure: floor, labelled scale mark, lines. */
export interface Picture {
  readonly figure: Figure
  readonly axes: Axes
  readonly fit: Fit
  readonly colors: Colors
  /** The label of the mark, such as “1 m”. */
  readonly label: string
}

export function paint(context: CanvasRenderingContext2D, picture: Picture, width: number, height: number): void {
  context.clearRect(0, 0, width, height)
  context.lineCap = context.lineJoin = 'round'
  paintFloor(context, picture)
  paintMark(context, picture, height)
  paintFigure(context, picture)
}

function pointer({ axes, fit }: Picture, context: CanvasRenderingContext2D) {
  const x = (px: number, py: number, pz: number) => fit.x + fit.scale * along(axes.x, px, py, pz)
  const y = (px: number, py: number, pz: number) => fit.y - fit.scale * along(axes.y, px, py, pz)
  return {
    x,
    y,
    line(from: readonly [number, number, number], to: readonly [number, number, number]) {
      context.moveTo(x(...from), y(...from))
      context.lineTo(x(...to), y(...to))
    },
  }
}

function paintFloor(context: CanvasRenderingContext2D, picture: Picture): void {
  const { floor, mark } = picture.fit
  if (!floor) return
  const at = pointer(picture, context)
  context.strokeStyle = picture.colors.floor
  context.lineWidth = 1
  context.beginPath()
  for (let k = 0; floor.x[0] + k * mark <= floor.x[1] + mark / 2; ++k) at.line([floor.x[0] + k * mark, 0, floor.z[0]], [floor.x[0] + k * mark, 0, floor.z[1]])
  for (let k = 0; floor.z[0] + k * mark <= floor.z[1] + mark / 2; ++k) at.line([floor.x[0], 0, floor.z[0] + k * mark], [floor.x[1], 0, floor.z[0] + k * mark])
  context.stroke()
}

/** Draws a vertical scale mark at the left edge. */
function paintMark(context: CanvasRenderingContext2D, { axes, fit, colors, label }: Picture, height: number): void {
  const length = fit.scale * fit.mark * axes.y[1],
    x = 10,
    foot = height - 10
  context.strokeStyle = context.fillStyle = colors.mark
  context.lineWidth = 1.5
  context.beginPath()
  context.moveTo(x - 4, foot)
  context.lineTo(x + 4, foot)
  context.moveTo(x, foot)
  context.lineTo(x, foot - length)
  context.moveTo(x - 4, foot - length)
  context.lineTo(x + 4, foot - length)
  context.stroke()
  context.font = '12px system-ui, sans-serif'
  context.textBaseline = 'middle'
  context.fillText(label, x + 8, foot - Math.min(length / 2, height / 2))
}

function paintFigure(context: CanvasRenderingContext2D, picture: Picture): void {
  const { figure, colors, fit } = picture
  const at = pointer(picture, context)
  const place = (point: number): [number, number, number] => [figure.points[3 * point], figure.points[3 * point + 1], figure.points[3 * point + 2]]
  for (const side of ['middle', 'left', 'right'] as const) {
    for (const thin of [false, true]) {
      context.strokeStyle = colors[side]
      context.lineWidth = thin ? 1.25 : 3
      context.beginPath()
      for (const line of figure.lines) if (line.side === side && line.thin === thin) at.line(place(line.from), place(line.to))
      context.stroke()
    }
  }
  if (!figure.head) return
  const from = place(figure.head.from),
    to = place(figure.head.to)
  const middle = from.map((value, axis) => (value + to[axis]) / 2) as [number, number, number]
  context.strokeStyle = colors.middle
  context.lineWidth = 2
  context.beginPath()
  context.arc(at.x(...middle), at.y(...middle), Math.max(1, (fit.scale * Math.hypot(...from.map((value, axis) => to[axis] - value))) / 2), 0, 2 * Math.PI)
  context.stroke()
}
