/** Until the view of an address is there: for the player until it draws its signers, and with `whole` until all frames have come. */
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
 * Until what was asked for is on the screen: the frames have come, the camera rests, and what does not play is drawn no more. However long one picture
 * takes.
 */
export async function drawn(page) {
  await page.waitForFunction(async () => {
    const stage = window.signweaveStage
    if (!stage || stage.transport.playing) return true
    const from = stage.pictures
    for (let i = 0; i < 3; ++i) await new Promise(requestAnimationFrame)
    await new Promise((resolve) => setTimeout(resolve, 400))
    return stage.still && stage.pictures === from
  })
}

/** Until `check` throws nothing. It is tried again and again for so many seconds; then what it threw last is thrown. */
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

/** Until a page has drawn so many frames: what would happen in them has happened. */
export const frames = (page, count = 20) =>
  page.evaluate(async (n) => {
    for (let i = 0; i < n; ++i) await new Promise(requestAnimationFrame)
  }, count)
