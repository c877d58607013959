/** Returns a curve like that of a hand's height, as SVG path data: from (`x`, `y`) to the right, at most `height` high. */
export function curve(x: number, y: number, width: number, height: number, phase: number): string {
  const points = Array.from({ length: Math.round(width / 4) + 1 }, (_, k) => {
    const t = (x + 4 * k) / 34 + phase
    const up = (0.55 * Math.sin(t) + 0.3 * Math.sin(1.9 * t + 1) + 0.15 * Math.sin(3.1 * t) + 1) / 2
    return `${x + 4 * k} ${(y + height * (1 - up)).toFixed(1)}`
  })
  return `M${points.join('L')}`
}
