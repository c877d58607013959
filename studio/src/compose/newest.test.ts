import { expect, it } from 'vitest'
import { Newest } from './newest'

/** Work that ends on command. */
function work() {
  let end: (value: string) => void = () => {},
    fail: (fault: Error) => void = () => {},
    signal: AbortSignal | undefined
  const done = new Promise<string>((resolve, reject) => ((end = resolve), (fail = reject)))
  return { run: (given: AbortSignal) => ((signal = given), done), end, fail, aborted: () => signal?.aborted }
}

it('returns only the newest result, and stops the previous task', async () => {
  const newest = new Newest(),
    first = work(),
    second = work(),
    third = work()
  const results = [newest.run(first.run, () => 0), newest.run(second.run, () => 0), newest.run(third.run, () => 0)]
  expect([first.aborted(), second.aborted(), third.aborted()]).toEqual([true, true, false])
  first.end('slow')
  second.fail(new Error('aborted'))
  third.end('new')
  expect(await Promise.all(results)).toEqual([{ kind: 'overtaken' }, { kind: 'overtaken' }, { kind: 'done', value: 'new' }])
})

it('returns nothing if the base state has changed meanwhile', async () => {
  const newest = new Newest(),
    slow = work()
  let project = {}
  const result = newest.run(slow.run, () => project)
  project = {}
  slow.end('old')
  expect(await result).toEqual({ kind: 'changed' })
  expect(
    await newest.run(
      () => Promise.reject(new Error('gone')),
      () => project,
    ),
  ).toEqual({ kind: 'failed', fault: new Error('gone') })
})
