import type { Api } from '../api/client'
import type { Text } from '../text/en'
import { Drawing } from './drawing'
import { Film } from './film'
import { gather } from './gather'
import { everyMoment } from './moments'
import type { RenderRequest } from './request'

/** Renders a video in a page that stays responsive: like `signweave render`, with every frame. Rejects if `signal` aborts it. */
export async function filmOf(api: Api, request: RenderRequest, progress: (done: number, of: number) => void, signal: AbortSignal, text?: Text): Promise<Blob> {
  const { width, height, rate } = request
  const motion = await gather(api, request, signal)
  const { seconds } = everyMoment(motion.store.length, motion.store.rate, rate)
  progress(0, seconds.length)
  const film = await Film.of(width, height, rate)
  const drawing = await Drawing.of(api, motion, request, text)
  try {
    for (let picture = 0; picture < seconds.length; ++picture) {
      signal.throwIfAborted()
      drawing.draw(seconds[picture])
      await film.add(drawing.canvas)
      progress(picture + 1, seconds.length)
      await breath()
    }
    return new Blob([await film.end()], { type: 'video/webm' })
  } catch (fault) {
    film.giveUp()
    throw fault
  } finally {
    drawing.dispose()
  }
}

/** Yields to the page's other tasks, also while it is hidden and its timers are slow. */
function breath(): Promise<void> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel()
    port1.onmessage = () => {
      port1.close()
      resolve()
    }
    port2.postMessage(undefined)
  })
}
