/** Waits until the view of an address is there: for the player until it draws its signers, and with `whole` until all frames have arrived. */
export async function opened(page, hash, whole = false) {
  if (!/\/(recording|edit|sign)\//.test(hash)) {
    await page.waitForFunction(() => document.querySelector('main table, main form, main [data-ready], [role=alert]'))
    return
  }
  await page.waitForFunction(
    (all) => {
      if (document.querySelector('[role=alert]')) return true
      const panes = window.signweaveStage?.panes ?? []
      return (
        document.querySelector('.player')?.dataset.annotated === 'true' &&
        panes.length > 0 &&
        panes.every(({ seen, body, motion, store }) => seen && (!motion.character || body.morphs) && (all ? store.arrived >= store.length : store.arrived > 0))
      )
    },
    whole && !/pace=live/.test(hash),
  )
}

/**
 * Waits until a live stream has signed a gloss, and the player names it where it was signed. A slow page may have drawn no frame of it meanwhile, so this seeks
 * to its first frame, and back.
 */
export async function signedLive(page, gloss) {
  await page.waitForFunction((wanted) => {
    const signed = document.querySelector('.player')?.dataset.signed ?? ''
    const frame = Number(
      signed
        .split(' ')
        .findLast((one) => one.startsWith(`${wanted}@`))
        ?.split('@')[1],
    )
    const stage = window.signweaveStage
    if (!(stage?.transport.duration * stage?.transport.rate > frame + 1)) return false
    stage.transport.pause()
    stage.transport.seek((frame + 0.5) / stage.transport.rate)
    stage.touch()
    return true
  }, gloss)
  await page.waitForFunction((wanted) => document.querySelector('.labels .gloss')?.textContent === wanted, gloss)
  await page.evaluate(() => window.signweaveStage.transport.play())
}

/**
 * Waits until the requested picture is on the screen: the frames have arrived, the camera is at rest, and a paused view is no longer redrawn. However long one
 * frame takes.
 */
export async function drawn(page) {
  // Not waitForFunction, which evaluates a promise only once, and accepts any.
  await page.evaluate(async () => {
    const pictures = async (count) => {
      for (let i = 0; i < count; ++i) await new Promise(requestAnimationFrame)
    }
    for (;;) {
      await pictures(3)
      const stage = window.signweaveStage
      if (!stage || stage.transport.playing) return
      if (!stage.still) continue
      // A pixel can be read when the graphics card (here software) has finished all work; then the browser shows it.
      const before = stage.pictures,
        gl = stage.renderer.getContext()
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4))
      await pictures(3)
      if (stage.still && stage.pictures === before) return
    }
  })
}

/** Waits until `check` no longer throws. It is retried for the given seconds; then its last error is thrown. */
export async function until(check, seconds = 30) {
  for (const end = performance.now() + 1000 * seconds; ;) {
    try {
      return await check()
    } catch (fault) {
      if (performance.now() > end) throw fault
    }
    await new Promise((resolve) => setTimeout(resolve, 50))
  }
}

/** Waits until a page has drawn the given number of frames: anything due in them has happened. */
export const frames = (page, count = 20) =>
  page.evaluate(async (n) => {
    for (let i = 0; i < n; ++i) await new Promise(requestAnimationFrame)
  }, count)
