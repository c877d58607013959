/**
 * Keeps open what `run(work)` has open while `work` runs: `given` resolves with what `work` was called with, or rejects where it could not be opened;
 * `end()` lets it go.
 */
export function hold(run) {
  let release, whole
  let isOpen = false
  const released = new Promise((resolve) => {
    release = resolve
  })
  const given = new Promise((ready, broken) => {
    whole = run(async (...things) => {
      isOpen = true
      ready(things)
      await released
    })
    whole.catch(broken)
  })
  return {
    given,
    end: async () => {
      release()
      if (isOpen) await whole
    },
  }
}
