/**
 * Keeps open what `run(work)` has open while `work` runs: `given` resolves with what `work` was called with, `end()` lets it go.
 */
export function hold(run) {
  let release, whole
  const released = new Promise((resolve) => {
    release = resolve
  })
  const given = new Promise((ready, broken) => {
    whole = run(async (...things) => {
      ready(things)
      await released
    })
    whole.catch(broken)
  })
  return {
    given,
    end: async () => {
      release()
      await whole
    },
  }
}
