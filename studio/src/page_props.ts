import type { Api } from './api/client'
import type { Route, WorkState } from './ui/route'
import type { Wardrobe } from './viewer/wardrobe.svelte'

/** The properties of every working page. */
export interface PageProps {
  readonly api: Api
  readonly wardrobe: Wardrobe
  readonly database: string
  readonly recording?: string
  /** The page's state from the address; changes when the user goes back or follows a link. */
  readonly state: WorkState
  readonly go: (to: Route) => void
  /** To be called when the list of recordings in the database has changed. */
  readonly onchange: () => void
}
