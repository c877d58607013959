/** Borders of annotations that can be dragged, in ms of annotation time; `tier` counts the timeline's rows. */
export interface Borders {
  /** Returns whether a border lies within `reach` ms. */
  isNear(tier: number, ms: number, reach: number): boolean
  /** Grabs the border there; returns false if there is none. */
  grab(tier: number, ms: number, reach: number): boolean
  /** Moves the grabbed border. */
  drag(ms: number): void
  /** Releases it. */
  drop(): void
}
