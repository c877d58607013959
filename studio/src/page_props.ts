import type { Api } from './api/client'
import type { Route, WorkState } from './ui/route'
import type { Wardrobe } from './viewer/wardrobe.svelte'

/** What every page that one works on is given. */
export interface PageProps {
  readonly api: Api
  readonly wardrobe: Wardrobe
  readonly database: string
  readonly recording?: string
  /** What the address says of the page; changes where the user goes back, or follows a link. */
  readonly state: WorkState
  readonly go: (to: Route) => void
  /** To be called where the database's recordings became others. */
  readonly onchange: () => void
}
