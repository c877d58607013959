/** Whether it is files of the disk that are dragged. A picture of a page is a file to browsers, too, but comes with its text. */
export function isOfFiles({ dataTransfer }: DragEvent): boolean {
  return dataTransfer !== null && dataTransfer.types.includes('Files') && !dataTransfer.types.includes('text/html')
}

/** Browsers tell of what is dragged over a page at least three times a second. */
const kSilence = 1000

/**
 * Whether files are over something. What is entered and left within does not count: a child that goes away is never left, nor is the
 * window always, so that silence, too, is the end.
 */
export class FileDrag {
  over = $state(false)
  private timer?: ReturnType<typeof setTimeout>

  here(): void {
    this.over = true
    clearTimeout(this.timer)
    this.timer = setTimeout(() => (this.over = false), kSilence)
  }
  /** For `dragleave` of an element and all that is in it. */
  left({ relatedTarget }: DragEvent, whole: Node): void {
    if (!(relatedTarget instanceof Node && whole.contains(relatedTarget))) this.gone()
  }
  gone(): void {
    clearTimeout(this.timer)
    this.over = false
  }
}
