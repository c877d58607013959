import { afterEach, beforeEach, expect, it, vi } from 'vitest'
import { Api } from './client'
import { ApiError, StudioFault } from './fault'

/** Mocks the server's answers, one after the other; undefined means that the server is unreachable. The last answer repeats. */
function answering(...answers: readonly ({ status?: number; body: object } | undefined)[]) {
  let n = 0
  vi.stubGlobal('fetch', () => {
    const answer = answers[Math.min(n++, answers.length - 1)]
    return answer
      ? Promise.resolve(new Response(JSON.stringify(answer.body), { status: answer.status ?? 200 }))
      : Promise.reject(new TypeError('Failed to fetch'))
  })
}
beforeEach(() => void vi.useFakeTimers())
afterEach(() => (vi.useRealTimers(), vi.unstubAllGlobals()))

/** Returns the result of a job while fake time passes. */
async function waited(api: Api): Promise<unknown> {
  const over = api.result({ job: '7' }).catch((fault: unknown) => fault)
  await vi.advanceTimersByTimeAsync(120_000)
  return over
}

it('waits for a job while the server is unreachable', async () => {
  answering({ body: { state: 'running' } }, undefined, undefined, { body: { state: 'done', result: 'stored' } })
  expect(await waited(new Api())).toBe('stored')
})

it('abandons a job if the server stays unreachable or does not know it', async () => {
  answering(undefined)
  expect(await waited(new Api())).toBeInstanceOf(StudioFault)
  answering({ status: 404, body: { error: { message: 'no job 7', code: 'not_found' } } })
  expect(await waited(new Api())).toBeInstanceOf(ApiError)
})

it('reports the declarations of recordings by database', async () => {
  const api = new Api(),
    heard: unknown[] = []
  api.onDeclarations = (declarations, database) => heard.push([database, declarations])
  const said = { 'signweave:placeholder': 'shapes' }
  vi.stubGlobal('fetch', (url: string) =>
    Promise.resolve(
      new Response(
        JSON.stringify({
          databases: [
            { name: 'a', declarations: said },
            { name: 'b', declarations: {} },
          ],
          recordings: [],
        }),
        { headers: /b%C3%A9|databases$/.test(url) ? { 'Signweave-Declarations': JSON.stringify(said) } : {} },
      ),
    ),
  )
  await api.databases()
  await api.recordings('a')
  await api.recordings('bé')
  expect(heard).toEqual([
    ['a', said],
    ['bé', said],
  ])
})

it('lists the methods that make transitions, in the server’s order', async () => {
  const methods = [
    { name: 'kriging', description: 'predicted from captured transitions' },
    { name: 'hermite', description: 'a cubic curve' },
  ]
  const fetched = vi.fn((_: string) => Promise.resolve(new Response(JSON.stringify(methods))))
  vi.stubGlobal('fetch', fetched)
  expect(await new Api().methods()).toEqual(methods)
  expect(fetched.mock.calls.map(([url]) => url)).toEqual(['api/methods'])
})

it('throws if an explained synthesis lacks its candidates', async () => {
  answering({ body: { frames: 0 } })
  await expect(new Api().explained('a', {})).rejects.toEqual(new StudioFault('badAnswer', 'places'))
})
