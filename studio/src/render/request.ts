export const kRenderViews = ['front', 'side', 'hands'] as const
export type RenderView = (typeof kRenderViews)[number]

/** What `signweave render` asks of the page: JSON behind `#` in its address. */
export interface RenderRequest {
  readonly database: string
  readonly call: 'sign' | 'edit' | 'recording'
  /** The body of the call; of a recording its name, and from when to when in ms of annotation time. */
  readonly parameters: Readonly<Record<string, unknown>>
  /** Whose surfaces are drawn; empty for the body that the studio draws itself. */
  readonly character: string
  /** Pixels. */
  readonly width: number
  readonly height: number
  /** Pictures a second. */
  readonly rate: number
  readonly view: RenderView
  readonly kind: 'webm' | 'png'
  /** Moments to draw, in ms from the first frame; null for every picture that `rate` asks for. */
  readonly at_ms: readonly number[] | null
  /** Address under which the results are put. */
  readonly put: string
}

const kMostPixels = 4096

/** What stands behind `#` as JSON; throws in plain words where it is none. */
export function requestIn(hash: string): unknown {
  try {
    return JSON.parse(decodeURIComponent(hash.replace(/^#/, '')))
  } catch {
    throw new Error('the address of this page has no render request behind #')
  }
}

/** Where the results of a request go, as far as it says so; it may be wrong in everything else. */
export function putOf(request: unknown): string | undefined {
  const put = (request as { put?: unknown } | null)?.put
  return typeof put === 'string' && put.startsWith('/') ? put : undefined
}

/** Throws in plain words where a request is not one. */
export function checked(request: unknown): RenderRequest {
  const given = request as RenderRequest
  const must = (right: boolean, what: string) => {
    if (!right) throw new Error(`the render request has no ${what}`)
  }
  must(typeof request === 'object' && request !== null, 'fields')
  must(typeof given.database === 'string' && given.database !== '', 'database')
  must(['sign', 'edit', 'recording'].includes(given.call), 'call: sign, edit or recording')
  must(typeof given.parameters === 'object' && given.parameters !== null, 'parameters')
  must(given.call !== 'recording' || typeof given.parameters.recording === 'string', 'recording')
  must(typeof given.character === 'string', 'character')
  for (const side of ['width', 'height'] as const) {
    must(Number.isInteger(given[side]) && given[side] >= 16 && given[side] <= kMostPixels, `${side} of 16 to ${kMostPixels} pixels`)
  }
  must(typeof given.rate === 'number' && given.rate > 0 && given.rate <= 2000, 'rate of at most 2000 pictures a second')
  must(kRenderViews.includes(given.view), `view: ${kRenderViews.join(', ')}`)
  must(['webm', 'png'].includes(given.kind), 'kind: webm or png')
  must(given.at_ms === null || (Array.isArray(given.at_ms) && given.at_ms.length > 0 && given.at_ms.every(Number.isFinite)), 'list of moments in at_ms')
  must(given.at_ms === null || given.kind === 'png', 'film of single moments: at_ms is for png')
  must(putOf(given) !== undefined, 'put')
  return given
}
