/** Keeps open what `run(work)` opens for `work`: `given` resolves with the argument of `work`, or rejects if opening failed; `end()` releases it. */
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
