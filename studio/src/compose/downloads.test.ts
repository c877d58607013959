import { expect, it } from 'vitest'
import { Downloads } from './downloads'

it('prepares files in parallel, and lists those in preparation', async () => {
  const saved: string[] = [],
    said: unknown[] = [],
    ends: ((fault?: Error) => void)[] = []
  const make = (signal: AbortSignal) =>
    new Promise<Blob>((resolve, reject) => {
      ends.push((fault) => (fault ? reject(fault) : resolve(new Blob())))
      signal.addEventListener('abort', () => reject(signal.reason))
    })
  const downloads = new Downloads(
    (_, name) => saved.push(name),
    (names, done) => said.push([names.join(), done?.name, done?.fault && 'fault']),
  )
  const all = [downloads.get('a.bvh', make), downloads.get('a.glb', make), downloads.get('a.eaf', make)]
  ends[0]()
  await all[0]
  ends[1](new Error('full'))
  await all[1]
  downloads.stop()
  await all[2]
  expect(saved).toEqual(['a.bvh'])
  expect(said).toEqual([
    ['a.bvh', undefined, undefined],
    ['a.bvh,a.glb', undefined, undefined],
    ['a.bvh,a.glb,a.eaf', undefined, undefined],
    ['a.glb,a.eaf', 'a.bvh', undefined],
    ['a.eaf', 'a.glb', 'fault'],
  ])
})
