import type { Annotation, AnnotationDocument, LaneKind, Tier } from '../annotation/document'
import type { FrameStore } from '../motion/frame_store'
import { extentOf, valueAt, type Curve } from './curves'
import { clock } from '../ui/clock'
import { kindOf, type BoxKind } from './tier_kind'
import { tickStep, type TimeWindow } from './window'

export const kRulerHeight = 24
export const kTierHeight = 25
export const kCurveHeight = 50

/** The colours of the theme, read when the theme changes. */
export type Colors = Readonly<Record<string, string>>
const kColorNames = [
  'panel',
  'raised',
  'line',
  'ink',
  'soft',
  'preparation',
  'stroke',
  'retraction',
  'other',
  'gloss',
  'chip-ink',
  'stroke-ink',
  'curve-left',
  'curve-right',
  'focus',
] as const

export function colorsOf(element: Element): Colors {
  const style = getComputedStyle(element)
  return Object.fromEntries(kColorNames.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]))
}

const kFill: Readonly<Record<BoxKind | LaneKind, string>> = {
  gloss: 'gloss',
  preparation: 'preparation',
  stroke: 'stroke',
  retraction: 'retraction',
  source: 'other',
  junction: 'retraction',
  other: 'other',
  clip: 'gloss',
  shared: 'other',
  transition: 'retraction',
  hold: 'gloss',
  movement: 'preparation',
}

export interface Drawing {
  readonly window: TimeWindow
  readonly document: AnnotationDocument
  /** Annotation time of frame 0, ms. */
  readonly originMs: number
  readonly store: FrameStore
  readonly curves: readonly Curve[]
  readonly colors: Colors
  /** For number formatting. */
  readonly language: string
}

export function heightOf(tiers: number, curves: number): number {
  return kRulerHeight + tiers * kTierHeight + curves * kCurveHeight
}

/** Draws everything on the timeline that does not move during playback. */
export function drawTimeline(context: CanvasRenderingContext2D, drawing: Drawing): void {
  const { window, document, colors } = drawing
  const width = window.pixels
  context.clearRect(0, 0, width, heightOf(document.tiers.length, drawing.curves.length))
  context.font = '12px system-ui, "Segoe UI", "DejaVu Sans", sans-serif'
  context.textBaseline = 'middle'
  drawRuler(context, drawing)
  document.tiers.forEach((tier, t) => {
    const y = kRulerHeight + t * kTierHeight
    if (t % 2 === 0) {
      context.fillStyle = colors.raised
      context.globalAlpha = 0.35
      context.fillRect(0, y, width, kTierHeight)
      context.globalAlpha = 1
    }
    drawTier(context, drawing, tier, y)
  })
  drawing.curves.forEach((curve, c) => drawCurve(context, drawing, curve, kRulerHeight + document.tiers.length * kTierHeight + c * kCurveHeight))
}

function drawRuler(context: CanvasRenderingContext2D, { window, colors, originMs, document, curves }: Drawing): void {
  const step = tickStep((window.span / window.pixels) * 76)
  const origin = originMs / 1000
  const bottom = heightOf(document.tiers.length, curves.length)
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9))
  context.textAlign = 'left'
  for (let k = Math.ceil((window.begin + origin) / step); k * step <= window.end + origin; ++k) {
    const x = Math.round(window.x(k * step - origin)) + 0.5
    line(context, x, 14, x, bottom, colors.line, 0.5)
    context.fillStyle = colors.soft
    context.fillText(clock(k * step, digits), x + 3, 9)
  }
  line(context, 0, kRulerHeight - 0.5, window.pixels, kRulerHeight - 0.5, colors.line, 1)
}

/** States are also marked by a symbol, not only by their style. */
const kStates: Readonly<Record<NonNullable<Annotation['state']>, string>> = { open: '?', accepted: '✓', unseen: '✓?', rejected: '✗' }

function drawTier(context: CanvasRenderingContext2D, { window, colors, originMs }: Drawing, tier: Tier, y: number): void {
  let from = firstEndAfter(tier, window.begin * 1000 + originMs)
  for (; from < tier.annotations.length; ++from) {
    const { begin, end, label, state, current, kind: lane } = tier.annotations[from]
    const left = window.x((begin - originMs) / 1000),
      right = window.x((end - originMs) / 1000)
    if (left > window.pixels) break
    const kind = lane ?? kindOf(tier.name, tier.depth, label)
    const width = Math.max(1.5, right - left - 1),
      isFull = state === undefined || state === 'accepted'
    context.fillStyle = context.strokeStyle = colors[kFill[kind]]
    if (kind === 'hold') held(context, left + 1.5, y + 4, Math.max(1, width - 2), kTierHeight - 8)
    else if (isFull) box(context, left + 0.5, y + 3, width, kTierHeight - 6)
    else outline(context, left + 1.5, y + 4, Math.max(1, width - 2), kTierHeight - 8, state === 'rejected' ? [3, 3] : [], 2)
    if (current) {
      context.strokeStyle = colors.focus
      outline(context, left, y + 1.5, Math.max(2, width + 1), kTierHeight - 3, [], 2.5)
    }
    const space = Math.min(right, window.pixels) - Math.max(left, 0) - 8
    if (space < 9) continue
    if (kind === 'hold') context.fillStyle = colors.ink
    else context.fillStyle = !isFull ? colors[state === 'rejected' ? 'soft' : 'ink'] : kind === 'stroke' ? colors['stroke-ink'] : colors['chip-ink']
    context.textAlign = 'left'
    context.fillText(shortened(context, state ? `${kStates[state]} ${label}` : label, space), Math.max(left, 0) + 4.5, y + kTierHeight / 2 + 0.5)
  }
}

function drawCurve(context: CanvasRenderingContext2D, { window, colors, store, language }: Drawing, curve: Curve, y: number): void {
  const { low, high } = extentOf(store, curve)
  const top = y + 6,
    bottom = y + kCurveHeight - 6
  const place = (value: number) => bottom - ((value - low) / (high - low)) * (bottom - top)
  line(context, 0, y + 0.5, window.pixels, y + 0.5, colors.line, 1)
  const step = tickStep((high - low) / 3)
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9))
  const frames = { first: Math.max(0, Math.floor(window.begin * store.rate)), last: Math.min(store.length - 1, Math.ceil(window.end * store.rate)) }
  for (let k = Math.ceil(low / step); k * step <= high; ++k) line(context, 0, place(k * step), window.pixels, place(k * step), colors.line, 0.35)
  for (const hand of [0, 1] as const) {
    if (!store.hasHand[hand]) continue
    context.strokeStyle = colors[hand === 0 ? 'curve-left' : 'curve-right']
    context.lineWidth = 1.6
    context.setLineDash(hand === 0 ? [] : [5, 2.5])
    context.beginPath()
    drawFrames(context, store, curve, hand, frames, window, place)
    context.stroke()
  }
  context.setLineDash([])
  context.textAlign = 'right'
  for (let k = Math.ceil(low / step); k * step <= high; ++k) {
    const label = (k * step).toLocaleString(language, { minimumFractionDigits: digits, maximumFractionDigits: digits })
    context.fillStyle = colors.panel
    context.globalAlpha = 0.75
    context.fillRect(window.pixels - 8 - context.measureText(label).width, place(k * step) - 7, context.measureText(label).width + 6, 14)
    context.globalAlpha = 1
    context.fillStyle = colors.soft
    context.fillText(label, window.pixels - 5, place(k * step))
  }
}

/** The maximum number of frames sampled per pixel: an hour has hundreds, and drawing must not delay playback. */
const kOfPixel = 8

/** If there are more frames than pixels, draws the minimum and maximum of each pixel. */
function drawFrames(
  context: CanvasRenderingContext2D,
  store: FrameStore,
  curve: Curve,
  hand: 0 | 1,
  { first, last }: { first: number; last: number },
  window: TimeWindow,
  place: (value: number) => number,
): void {
  const perPixel = Math.max(1, Math.floor(((last - first) / window.pixels) * 0.75))
  const stride = Math.ceil(perPixel / kOfPixel)
  let drawing = false
  // Starts at a multiple, so that the same frames are sampled wherever the window begins.
  for (let frame = first - (first % perPixel); frame <= last; frame += perPixel) {
    let low = Infinity,
      high = -Infinity
    for (let f = frame; f < frame + perPixel && f <= last; f += stride) {
      const value = valueAt(store, curve, f, hand)
      if (value < low) low = value
      if (value > high) high = value
    }
    if (low === Infinity) {
      drawing = false
      continue
    }
    const x = window.x(frame / store.rate)
    if (drawing) context.lineTo(x, place(low))
    else context.moveTo(x, place(low))
    if (high > low) context.lineTo(x, place(high))
    drawing = true
  }
}

/** Returns the index of the first annotation of a tier that ends after `ms`, by binary search. */
export function firstEndAfter(tier: Tier, ms: number): number {
  let low = 0,
    high = tier.annotations.length
  while (low < high) {
    const middle = (low + high) >> 1
    if (tier.annotations[middle].end <= ms) low = middle + 1
    else high = middle
  }
  return low
}

function box(context: CanvasRenderingContext2D, x: number, y: number, width: number, height: number): void {
  context.beginPath()
  context.roundRect(x, y, width, height, Math.min(4, width / 3))
  context.fill()
}

function outline(context: CanvasRenderingContext2D, x: number, y: number, width: number, height: number, dash: number[], thick: number): void {
  context.lineWidth = thick
  context.setLineDash(dash)
  context.beginPath()
  context.roundRect(x, y, width, height, Math.min(4, width / 3))
  context.stroke()
  context.setLineDash([])
}

/** A held pose: a tint with a dashed outline. */
function held(context: CanvasRenderingContext2D, x: number, y: number, width: number, height: number): void {
  context.globalAlpha = 0.3
  context.fillRect(x, y, width, height)
  context.globalAlpha = 1
  outline(context, x, y, width, height, [4, 3], 2)
}

function line(context: CanvasRenderingContext2D, x: number, y: number, toX: number, toY: number, color: string, opacity: number): void {
  context.globalAlpha = opacity
  context.strokeStyle = color
  context.lineWidth = 1
  context.setLineDash([])
  context.beginPath()
  context.moveTo(x, y)
  context.lineTo(toX, toY)
  context.stroke()
  context.globalAlpha = 1
}

function shortened(context: CanvasRenderingContext2D, label: string, space: number): string {
  if (context.measureText(label).width <= space) return label
  let length = Math.max(0, Math.floor((label.length * space) / context.measureText(label).width) - 1)
  while (length > 1 && context.measureText(`${label.slice(0, length)}…`).width > space) --length
  return length >= 1 ? `${label.slice(0, length)}…` : ''
}
