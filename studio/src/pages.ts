import type { Component } from 'svelte'
import type { Api } from './api/client'
import type { Route, WorkPage, WorkState } from './ui/route'
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
type Page = Promise<{ readonly default: Component<PageProps> }>

/** Each is fetched when somebody goes there. */
export const kPages: Readonly<Record<WorkPage, () => Page>> = {
  compose: () => import('./compose/Compose.svelte'),
  search: () => import('./search/Search.svelte'),
  import: () => import('./corpus/Import.svelte'),
  phases: () => import('./corpus/Phases.svelte'),
  evaluate: () => import('./evaluate/Evaluate.svelte'),
  compare: () => import('./evaluate/Compare.svelte'),
  guide: () => import('./guide/Guide.svelte'),
}
