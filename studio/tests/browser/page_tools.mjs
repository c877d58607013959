import { readFileSync } from 'node:fs'
import { createRequire } from 'node:module'

const kAxe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8')

/** Helpers that inspect a page; `window.signweaveStage` is the stage that draws. */

export const transport = (page) =>
  page.evaluate(() => {
    const { time, playing, speed, repeat, loop, rate, duration } = window.signweaveStage.transport
    return { time, playing, speed, repeat, loop, rate, duration }
  })

export const azimuth = (page) => page.evaluate(() => window.signweaveStage.panes[0].camera.azimuth)

/** Returns the colour on the screen at a joint of the first signer, as [red, green, blue]. */
export async function colorAtJoint(page, joint, pane = 0) {
  const place = await page.evaluate(
    ([name, index]) => {
      const { panes } = window.signweaveStage,
        one = panes[index]
      const j = one.store.skeleton.joints.findIndex((row) => row.name === name)
      const { positions } = one.model,
        { camera } = one.camera
      const v = camera.position
        .clone()
        .set(positions[3 * j], positions[3 * j + 1], positions[3 * j + 2])
        .project(camera)
      const box = document.querySelector('.stage canvas').getBoundingClientRect(),
        width = box.width / panes.length
      return { x: Math.round(box.left + width * (index + (v.x + 1) / 2)), y: Math.round(box.top + ((1 - v.y) / 2) * box.height) }
    },
    [joint, pane],
  )
  const png = (await page.screenshot({ clip: { ...place, width: 1, height: 1 } })).toString('base64')
  return page.evaluate(async (data) => {
    const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob())
    const context = new OffscreenCanvas(1, 1).getContext('2d')
    context.drawImage(picture, 0, 0)
    return [...context.getImageData(0, 0, 1, 1).data].slice(0, 3)
  }, png)
}

/** Whether a colour is that of bare skin as the studio draws it, in light or shade. */
export const isSkin = ([red, green, blue]) => red > 60 && red > green * 1.12 && green > blue * 0.95

/** Returns the faults that axe finds, one line each. */
export async function axeFaults(page) {
  await page.evaluate(kAxe)
  const found = await page.evaluate(() => window.axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }))
  return found.violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target, failureSummary }) => `${target} ${failureSummary}`).join(' | ')}`)
}

/** Returns a second of video of a moving bar, as bytes of WebM, recorded by the browser itself. */
export async function smallVideo(page) {
  const base64 = await page.evaluate(async () => {
    const canvas = Object.assign(document.createElement('canvas'), { width: 64, height: 48 }),
      context = canvas.getContext('2d')
    const recorder = new MediaRecorder(canvas.captureStream(25), { mimeType: 'video/webm' }),
      parts = []
    recorder.ondataavailable = ({ data }) => parts.push(data)
    recorder.start()
    for (let i = 0; i < 40; ++i) {
      context.fillStyle = `hsl(${9 * i} 80% 50%)`
      context.fillRect(0, 0, 64, 48)
      await new Promise((resolve) => setTimeout(resolve, 40))
    }
    await new Promise((resolve) => {
      recorder.onstop = resolve
      recorder.stop()
    })
    const bytes = new Uint8Array(await new Blob(parts).arrayBuffer())
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''))
  })
  return Buffer.from(base64, 'base64')
}

/** Returns the ms that a page's main thread has computed so far, excluding waits for a processor. */
export async function computedBy(page) {
  const session = await page.context().newCDPSession(page)
  await session.send('Performance.enable', { timeDomain: 'threadTicks' })
  return async () => {
    const { metrics } = await session.send('Performance.getMetrics')
    return 1000 * metrics.find(({ name }) => name === 'ThreadTime').value
  }
}

/** Makes a page take the software renderer for a graphics card: shadows and antialiasing, however long they take. */
export function likeACard() {
  const { getParameter } = WebGL2RenderingContext.prototype
  WebGL2RenderingContext.prototype.getParameter = function (name) {
    return name === 0x9246 ? 'a card' : getParameter.call(this, name) // UNMASKED_RENDERER_WEBGL
  }
  const { getContext } = HTMLCanvasElement.prototype
  HTMLCanvasElement.prototype.getContext = function (kind, options) {
    return getContext.call(this, kind, { ...options, failIfMajorPerformanceCaveat: false })
  }
}
