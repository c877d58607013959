import { expect, it } from 'vitest'
import type { Api } from '../api/client'
import { ApiError, StudioFault } from '../api/fault'
import { Live } from './live.svelte'
import { LiveQueue } from './live_queue.svelte'
import type { Place } from './project'
import { signs } from './test_places'
import { textOf, wordOf } from './utterance'

const settled = () => new Promise((resolve) => setTimeout(resolve))
function words(append: (word: string) => Promise<void>) {
  const heard: string[] = []
  const one = new LiveQueue(append, {
    signed: (place: Place) => heard.push(`signed ${wordOf(place)}`),
    refused: (place: Place, fault: Error) => heard.push(`${wordOf(place)}: ${fault.message}`),
    back: (places: readonly Place[]) => heard.push(`back ${textOf(places)}`),
  })
  return { one, heard, say: (...glosses: string[]) => one.say(signs(...glosses)) }
}

it('signs words in the order in which they were typed, and reports every refused one', async () => {
  const { one, heard, say } = words(async (word) => {
    await settled()
    if (word.startsWith('NO')) throw new ApiError('no sign', 0, 'not_found')
  })
  say('A', 'NOB', 'B')
  say('NOC', 'C')
  expect(textOf(one.waiting)).toBe('A NOB B NOC C')
  for (let i = 0; i < 8; ++i) await settled()
  expect(heard).toEqual(['signed A', 'NOB: no sign', 'signed B', 'NOC: no sign', 'signed C'])
})

it('returns words without an available signer, and continues when they are sent again', async () => {
  let there = true
  const { heard, say } = words(async (word) => {
    if (word === 'B') there = false
    if (!there) throw new StudioFault('streamClosed')
  })
  say('A', 'B', 'C')
  await settled()
  there = true
  say('C')
  await settled()
  expect(heard).toEqual(['signed A', 'back B C', 'signed C'])
})

it('returns unanswered words when closed, and reports nothing more', async () => {
  let fail = (_: Error) => {}
  const { one, heard, say } = words(() => new Promise((_, reject) => (fail = reject)))
  say('A', 'B')
  expect(textOf(one.close())).toBe('A B')
  fail(new StudioFault('streamClosed'))
  await settled()
  expect(heard).toEqual([])
})

it('holds words until the stream is open, or has failed', async () => {
  const live = new Live({} as Api, 'd', 'r', {})
  let ended = ''
  const append = live.append('A').then(
    () => (ended = 'signed'),
    (fault: unknown) => (ended = fault instanceof StudioFault ? fault.kind : String(fault)),
  )
  await settled()
  expect(ended).toBe('')
  live.fail(new ApiError('no such character', 404, 'not_found'))
  await append
  expect([ended, live.trouble, live.busy]).toEqual(['streamClosed', new ApiError('no such character', 404, 'not_found'), false])
})
