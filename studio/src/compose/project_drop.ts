import { FileDrag, isOfFiles } from '../ui/file_drag.svelte'

export const isDialogOpen = () => document.querySelector('dialog[open]') !== null

/** Project files that are dragged over the page. Recordings and annotation are not for it: they are imported, as on every page. */
export class ProjectDrop {
  readonly drag = new FileDrag()

  constructor(private readonly onfile: (file: File) => void) {}

  drop(event: DragEvent): void {
    this.drag.gone()
    const [file, more] = event.dataTransfer?.files ?? []
    if (!file || more || !file.name.toLowerCase().endsWith('.json') || isDialogOpen()) return
    event.preventDefault()
    this.onfile(file)
  }
  /** Before the drop, a file has a type but no name. */
  over(event: DragEvent): void {
    const [file, more] = event.dataTransfer?.items ?? []
    if (!isOfFiles(event) || more || file?.type !== 'application/json' || isDialogOpen()) return
    event.preventDefault()
    this.drag.here()
  }
}
