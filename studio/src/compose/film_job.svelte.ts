import type { Api } from '../api/client'
import type { RenderRequest, RenderView } from '../render/request'
import type { Text } from '../text/en'
import type { SignBody } from './body'

/** The sizes of films. */
export const kFilmSizes = ['640x360', '1280x720', '1920x1080'] as const
export type FilmSize = (typeof kFilmSizes)[number]
/** Frames a second. */
const kRate = 30

/** Whether this browser can encode video. */
export const canFilm = (): boolean => typeof VideoEncoder !== 'undefined'

/** Renders a video in the page, frame by frame, without dropping any. */
export class FilmJob {
  done = $state(0)
  /** The total number of frames; 0 while the motion is being fetched. */
  of = $state(0)
  private readonly abort = new AbortController()

  cancel(): void {
    this.abort.abort()
  }

  /** Resolves with the file's bytes; with undefined if cancelled. `character` is the character drawn, `text` the language of the captions. */
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
    // The encoder is loaded on first use.
    const { filmOf } = await import('../render/film_of')
    try {
      return await filmOf(api, request, (done, of) => ((this.done = done), (this.of = of)), signal, text)
    } catch (fault) {
      if (signal.aborted) return undefined
      throw fault
    }
  }
}
