/** Whether files of the disk are being dragged. Browsers treat an image of a page as a file, too, but it comes with its text. */
export function isOfFiles({ dataTransfer }: DragEvent): boolean {
  return dataTransfer !== null && dataTransfer.types.includes('Files') && !dataTransfer.types.includes('text/html')
}

/** Browsers send dragover events at least three times a second. */
const kSilence = 1000

/**
 * Whether files are over an element. Enter and leave events within it are not counted: a removed child never sends one, and nor does the window always, so
 * silence also means the end.
 */
export class FileDrag {
  over = $state(false)
  private timer?: ReturnType<typeof setTimeout>

  here(): void {
    this.over = true
    clearTimeout(this.timer)
    this.timer = setTimeout(() => (this.over = false), kSilence)
  }
  /** For `dragleave` of an element and its descendants. */
  left({ relatedTarget }: DragEvent, whole: Node): void {
    if (!(relatedTarget instanceof Node && whole.contains(relatedTarget))) this.gone()
  }
  gone(): void {
    clearTimeout(this.timer)
    this.over = false
  }
}
