/** The view, encoded in the address after `#`, so that every view can be linked and the back key works. */
export type Route =
  | { readonly page: 'home' }
  | { readonly page: 'recordings'; readonly database: string }
  | {
      readonly page: 'recording'
      readonly database: string
      readonly recording: string
      readonly compare?: string
      readonly at: number
      /** The selection, in ms of annotation time. */ readonly span?: readonly [number, number]
    }
  | { readonly page: 'sign'; readonly database: string; readonly utterance: string; readonly pace: 'fast' | 'live' }
  | Working
  | { readonly page: 'edit'; readonly database: string; readonly recording: string; readonly replace: readonly string[]; readonly swap?: string }

/** A working page. Its state is in the address as the page itself writes it, so that it can be linked, too. */
export interface Working {
  readonly page: WorkPage
  readonly database: string
  /** For `phases`, the recording. */ readonly recording?: string
  readonly state: WorkState
}
export type WorkState = Readonly<Record<string, string>>
export type WorkPage = (typeof kWorkPages)[number]
export const kWorkPages = ['compose', 'search', 'import', 'phases', 'evaluate', 'compare', 'guide'] as const

/** Returns the address to go to from a missing recording or database: the database's recordings, otherwise the start page. */
export function linkBack(hash: string): string {
  const [, database, , name] = hash.split('?')[0].split('/')
  return database && name ? `#/${database}` : '#/'
}

/** Returns the address with another recording; undefined if it contains no recording. */
export function withRecording(hash: string, recording: string): string | undefined {
  const [, database, page, name] = hash.split('?')[0].split('/')
  return name ? `#/${database}/${page}/${encodeURIComponent(recording)}` : undefined
}

export function parseRoute(hash: string): Route {
  const [path, query = ''] = hash.replace(/^#\/?/, '').split('?', 2)
  const parameters = new URLSearchParams(query)
  let parts: string[]
  try {
    parts = path.split('/').filter(Boolean).map(decodeURIComponent)
  } catch {
    parts = []
  }
  const [database, page, name] = parts
  if (database && page === 'recording' && name) {
    return {
      page,
      database,
      recording: name,
      compare: parameters.get('compare') ?? parameters.get('beside') ?? undefined,
      at: Math.max(0, Number(parameters.get('at')) || 0),
      span: spanOf(parameters.get('span')),
    }
  }
  if (database && page === 'sign' && name) {
    return { page, database, utterance: name, pace: parameters.get('pace') === 'live' ? 'live' : 'fast' }
  }
  if (database && page === 'edit' && name) {
    return { page, database, recording: name, replace: parameters.getAll('replace'), swap: parameters.get('swap') ?? undefined }
  }
  const work = kWorkPages.find((one) => one === page)
  if (database && work) return { page: work, database, recording: name, state: Object.fromEntries(parameters) }
  return database ? { page: 'recordings', database } : { page: 'home' }
}

export function addressOf(route: Route): string {
  const parts = (...names: string[]) => '#/' + names.map(encodeURIComponent).join('/')
  const query = new URLSearchParams()
  switch (route.page) {
    case 'home':
      return '#/'
    case 'recordings':
      return parts(route.database)
    case 'compose':
    case 'search':
    case 'import':
    case 'phases':
    case 'evaluate':
    case 'compare':
    case 'guide':
      return withQuery(parts(route.database, route.page, ...(route.recording ? [route.recording] : [])), new URLSearchParams(route.state))
    case 'recording':
      if (route.compare) query.set('compare', route.compare)
      if (route.at) query.set('at', String(route.at))
      if (route.span) query.set('span', route.span.join('..'))
      return withQuery(parts(route.database, 'recording', route.recording), query)
    case 'sign':
      if (route.pace === 'live') query.set('pace', 'live')
      return withQuery(parts(route.database, 'sign', route.utterance), query)
    case 'edit':
      for (const one of route.replace) query.append('replace', one)
      if (route.swap) query.set('swap', route.swap)
      return withQuery(parts(route.database, 'edit', route.recording), query)
  }
}

/** `1200..3400`; undefined if the text does not match. */
function spanOf(text: string | null): readonly [number, number] | undefined {
  const [, from, to] = /^(-?\d+)\.\.(-?\d+)$/.exec(text ?? '') ?? []
  return from !== undefined && Number(from) < Number(to) ? [Number(from), Number(to)] : undefined
}

function withQuery(path: string, query: URLSearchParams): string {
  const text = query.toString()
  return text ? `${path}?${text}` : path
}
