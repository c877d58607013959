import { Api } from '../api/client'
import type { Delivery } from './delivery'
import { Drawing } from './drawing'
import { Film } from './film'
import { gather } from './gather'
import { chosenMoments, everyMoment } from './moments'
import type { RenderRequest } from './request'

/** Draws the request and sends the results to the server: a video or single images, one after the other, in order. */
export async function render(request: RenderRequest, delivery: Delivery): Promise<void> {
  const { width, height, rate, kind, at_ms } = request
  const api = new Api()
  delivery.progress(0, 0) // an initial report, because the first steps take longest
  const motion = await gather(api, request)
  const { store } = motion
  const { seconds, lasts } = at_ms ? chosenMoments(store.length, store.rate, at_ms) : everyMoment(store.length, store.rate, rate)
  const drawing = await Drawing.of(api, motion, request)
  const film = kind === 'webm' ? await Film.of(width, height, rate) : undefined
  for (let picture = 0; picture < seconds.length && !delivery.ended; ++picture) {
    drawing.draw(seconds[picture])
    if (film) await film.add(drawing.canvas)
    else await delivery.file(`${String(picture + 1).padStart(5, '0')}.png`, await drawing.canvas.convertToBlob({ type: 'image/png' }))
    delivery.progress(picture + 1, seconds.length)
  }
  if (film) await delivery.file('film.webm', await film.end())
  await delivery.done({ frames: seconds.length, seconds: lasts, codec: film?.codec ?? 'png' })
}
