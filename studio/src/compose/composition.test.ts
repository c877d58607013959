import { expect, it } from 'vitest'
import { Composition } from './composition.svelte'
import { signPlace } from './project'
import { linkTo } from './state'
import { readGlosses } from './test_places'
import { textOf, type ReadText } from './utterance'

const said = ({ project }: Composition) => textOf(project.places)
let databases = 0
/** Creates the page's state as at an address; `leave` opens another address afresh. */
async function come(state: Record<string, string>, database = `d${++databases}`, read = readGlosses) {
  const composition = new Composition(database, read)
  const wrong = await composition.follow(state)
  return { composition, wrong, leave: (to: Record<string, string>) => come(to, database) }
}
/** A server whose answers come when `answer` is called with their text. */
function slow() {
  const waiting = new Map<string, () => void>()
  const read: ReadText = (text) => new Promise((resolve, reject) => waiting.set(text, () => readGlosses(text).then(resolve, reject)))
  const answer = async (text: string) => {
    waiting.get(text)!()
    await new Promise((resolve) => setTimeout(resolve))
  }
  return { read, answer }
}

it('continues with the last change, even if the address was left before it was written, and can undo it', async () => {
  const { composition, leave } = await come({ utterance: 'A' })
  composition.insert(1, signPlace('B'))
  const again = await leave({ utterance: 'A' }) // with the back key
  expect([said(again.composition), again.composition.address()]).toEqual(['A B', { utterance: 'A B' }])
  again.composition.undo()
  expect([said(again.composition), again.composition.canRedo]).toEqual(['A', true])
  again.composition.redo()
  again.composition.address()
  expect(said((await leave({})).composition)).toBe('A B')
})

it('opens a link with different content', async () => {
  const { composition, leave } = await come({ utterance: 'A' })
  composition.insert(1, signPlace('B'))
  const other = (await leave({ utterance: 'C' })).composition
  expect([said(other), other.canUndo]).toEqual(['C', false])
  await other.follow({ utterance: 'D' })
  other.undo()
  expect(said(other)).toBe('C')
})

it('keeps the unreadable text of a link, also in the address, until there is other content', async () => {
  const { composition, wrong, leave } = await come({ utterance: 'A "B' })
  expect([composition.unread?.text, wrong, composition.address()]).toEqual(['A "B', ['utterance'], undefined])
  expect(String(composition.unread?.fault)).toContain('open_quote at 2')
  expect((await leave({ utterance: 'A "B' })).composition.unread?.text).toBe('A "B')
  composition.insert(0, signPlace('X'))
  expect([composition.unread?.text, composition.address()]).toEqual(['A "B', { utterance: 'X' }])
  expect((await leave({ utterance: 'X' })).composition.unread?.text).toBe('A "B')
  await composition.follow({ utterance: 'Y' })
  expect([composition.unread, said(composition)]).toEqual([undefined, 'Y'])
})

it('writes no address while one is being read, and adopts only the newest', async () => {
  const { read, answer } = slow(),
    composition = new Composition(`d${++databases}`, read)
  void composition.follow({ utterance: 'A' })
  void composition.follow({ utterance: 'B' })
  expect([composition.following, composition.address()]).toEqual([true, undefined])
  await answer('B')
  await answer('A')
  expect([said(composition), composition.following, composition.canUndo]).toEqual(['B', false, false])
})

it('leaves what the user changed while a link was being read', async () => {
  const { read, answer } = slow(),
    composition = new Composition(`d${++databases}`, read)
  void composition.follow({ utterance: 'A' })
  composition.insert(0, signPlace('X'))
  await answer('A')
  expect([said(composition), composition.address()]).toEqual(['X', { utterance: 'X' }])
})

it("links to a project without the user's token", async () => {
  const { composition } = await come({ utterance: 'A' })
  expect(linkTo(composition.project, 'demo', 'https://x.org/studio/?token=SECRET#/demo/compose?utterance=B')).toBe(
    'https://x.org/studio/#/demo/compose?utterance=A',
  )
})

it('names the unreadable parts of an address to a page that takes over before the address is written again', async () => {
  const { composition, wrong, leave } = await come({ utterance: 'A', tempo: 'fast' })
  expect(wrong).toEqual(['tempo'])
  expect((await leave({ utterance: 'A', tempo: 'fast' })).wrong).toEqual(['tempo'])
  composition.address()
  expect((await leave({})).wrong).toEqual([])
})
