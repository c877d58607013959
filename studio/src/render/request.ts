export const kRenderViews = ['front', 'side', 'hands'] as const
export type RenderView = (typeof kRenderViews)[number]

/** The request of `signweave render` to the page: JSON after `#` in its address. */
export interface RenderRequest {
  readonly database: string
  readonly call: 'sign' | 'edit' | 'recording'
  /** The body of the call; for a recording, its name and its span in ms of annotation time. */
  readonly parameters: Readonly<Record<string, unknown>>
  /** The character drawn; empty for the studio's plain body. */
  readonly character: string
  /** Pixels. */
  readonly width: number
  readonly height: number
  /** Frames a second. */
  readonly rate: number
  readonly view: RenderView
  readonly kind: 'webm' | 'png'
  /** Moments to draw, in ms from the first frame; null for every frame at `rate`. */
  readonly at_ms: readonly number[] | null
  /** The address to which the results are sent. */
  readonly put: string
}

const kMostPixels = 4096

/** Returns the JSON after `#`; throws with a readable message if it is invalid. */
export function requestIn(hash: string): unknown {
  try {
    return JSON.parse(decodeURIComponent(hash.replace(/^#/, '')))
  } catch {
    throw new Error('the address of this page contains no render request after #')
  }
}

/** Returns the address for the results of a request if it contains one, even if the rest is invalid. */
export function putOf(request: unknown): string | undefined {
  const put = (request as { put?: unknown } | null)?.put
  return typeof put === 'string' && put.startsWith('/') ? put : undefined
}

/** Throws with a readable message if a request is invalid. */
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
