import type { Component } from 'svelte'
import type { PageProps } from './page_props'
import type { WorkPage } from './ui/route'

type Page = Promise<{ readonly default: Component<PageProps> }>

/** Each page is loaded when it is first opened. */
export const kPages: Readonly<Record<WorkPage, () => Page>> = {
  compose: () => import('./compose/Compose.svelte'),
  search: () => import('./search/Search.svelte'),
  import: () => import('./corpus/Import.svelte'),
  phases: () => import('./corpus/Phases.svelte'),
  evaluate: () => import('./evaluate/Evaluate.svelte'),
  compare: () => import('./evaluate/Compare.svelte'),
  guide: () => import('./guide/Guide.svelte'),
}
