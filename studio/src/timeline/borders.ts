/** Ends of annotations that can be dragged, in ms of annotation time; `tier` counts the timeline's rows. */
export interface Borders {
  /** Whether an end lies within `reach` ms. */
  isNear(tier: number, ms: number, reach: number): boolean
  /** Takes the end that lies there; false where none does. */
  grab(tier: number, ms: number, reach: number): boolean
  /** Moves the one that was taken. */
  drag(ms: number): void
  /** Lets go of it. */
  drop(): void
}
