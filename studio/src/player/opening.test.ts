import { expect, it } from 'vitest'
import type { MotionSource, OpenedMotion } from '../motion/source'
import { Worn } from './opening'

/** A source that opens on command. */
function source(name: string, events: string[]) {
  let ready!: () => void, broken!: (fault: Error) => void
  const opened = new Promise<OpenedMotion>((resolve, reject) => ((ready = () => resolve({} as OpenedMotion)), (broken = reject)))
  return { ready, broken, source: { open: () => opened, close: () => void events.push(`closed ${name}`) } as unknown as MotionSource }
}
function wearing() {
  const events: string[] = [],
    made = new Map<string, ReturnType<typeof source>>()
  const worn = new Worn<string>(Promise.resolve('a'), {
    open: async (opening) => {
      const one = source(opening.character!, events)
      made.set(opening.character!, one)
      await opening.strand('only', one.source)
      return opening.character!
    },
    shown: (name) => events.push(`shown ${name}`),
    progress: () => events.push('progress'),
    note: (fault) => events.push(`compared: ${(fault as Error).message}`),
    fail: (fault) => events.push(`none: ${(fault as Error).message}`),
  })
  const settled = () => new Promise((resolve) => setTimeout(resolve))
  return { events, made, worn, settled }
}

it('keeps the current motions until the same are open in other joints', async () => {
  const { events, made, worn, settled } = wearing()
  await settled()
  made.get('a')!.ready()
  await settled()
  worn.wear('b')
  worn.wear('c') // b is no longer needed
  made.get('b')!.ready()
  await settled()
  expect(events).toEqual(['shown a', 'closed b'])
  made.get('c')!.ready()
  await settled()
  expect(events.slice(2)).toEqual(['closed a', 'shown c'])
  worn.wear('d')
  made.get('d')!.broken(new Error('no d'))
  await settled()
  expect(events.slice(4)).toEqual(['closed d', 'compared: no d'])
  worn.close()
  made.get('c')!.source.onProgress?.(true)
  expect(events.slice(6)).toEqual(['closed c'])
})

it('reports a failure, and nothing once closed', async () => {
  const { events, made, settled } = wearing()
  await settled()
  made.get('a')!.broken(new Error('no a'))
  await settled()
  expect(events).toEqual(['closed a', 'none: no a'])
  const other = wearing()
  await settled()
  other.worn.close()
  other.made.get('a')!.broken(new Error('no a'))
  await settled()
  expect(other.events).toEqual(['closed a', 'closed a'])
})
