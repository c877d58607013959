import type { Api } from '../api/client'
import type { RenderRequest, RenderView } from '../render/request'
import type { Text } from '../text/en'
import type { SignBody } from './body'

/** How large films are. */
export const kFilmSizes = ['640x360', '1280x720', '1920x1080'] as const
export type FilmSize = (typeof kFilmSizes)[number]
/** Pictures a second. */
const kRate = 30

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

  /** Resolves with the film's bytes; none where it was given up. `character` is whose surfaces are drawn, `text` the language beneath the pictures. */
  async make(
    api: Api,
    database: string,
    body: SignBody,
    character: string | undefined,
    view: RenderView,
    size: FilmSize,
    text: Text,
  ): Promise<Blob | undefined> {
    const { signal } = this.abort
    const [width, height] = size.split('x').map(Number)
    const request: RenderRequest = {
      database,
      call: 'sign',
      parameters: { ...body },
      character: character ?? '',
      width,
      height,
      rate: kRate,
      view,
      kind: 'webm',
      at_ms: null,
      put: '',
    }
    // What makes films is fetched by those who want one.
    const { filmOf } = await import('../render/film_of')
    try {
      return await filmOf(api, request, (done, of) => ((this.done = done), (this.of = of)), signal, text)
    } catch (fault) {
      if (signal.aborted) return undefined
      throw fault
    }
  }
}
