import type { Api } from '../api/client'
import type { RenderRequest, RenderView } from '../render/request'
import type { SignBody } from './body'

/** How large films are, and how many pictures a second. */
const kFilm = { width: 1280, height: 720, rate: 30 } as const

/** Whether this browser can make films at all. */
export const canFilm = (): boolean => typeof VideoEncoder !== 'undefined'

/** A film that is being made in the page, picture by picture, none left out. */
export class FilmJob {
  done = $state(0)
  /** How many pictures there will be; 0 while the motion is fetched. */
  of = $state(0)
  private readonly abort = new AbortController()

  cancel(): void {
    this.abort.abort()
  }
  get cancelled(): boolean {
    return this.abort.signal.aborted
  }

  /** Resolves with the film's bytes; none where it was given up. `character` is whose surfaces are drawn. */
  async make(api: Api, database: string, body: SignBody, character: string | undefined, view: RenderView): Promise<Blob | undefined> {
    const { signal } = this.abort
    const request: RenderRequest = { database, call: 'sign', parameters: { ...body }, character: character ?? '', ...kFilm, view, kind: 'webm', at_ms: null, put: '' }
    // What makes films is fetched by those who want one.
    const { filmOf } = await import('../render/film_of')
    try {
      return await filmOf(api, request, (done, of) => ((this.done = done), (this.of = of)), signal)
    } catch (fault) {
      if (signal.aborted) return undefined
      throw fault
    }
  }
}
