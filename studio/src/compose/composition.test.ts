import { expect, it } from 'vitest'
import { Composition } from './composition.svelte'
import { signPlace } from './project'
import { linkTo } from './state'
import { textOf } from './utterance'

const said = ({ project }: Composition) => textOf(project.places)
let databases = 0
/** Creates the page's state as at an address; `leave` opens another address afresh. */
function come(state: Record<string, string>, database = `d${++databases}`) {
  const composition = new Composition(database)
  const wrong = composition.follow(state)
  return { composition, wrong, leave: (to: Record<string, string>) => come(to, database) }
}

it('continues with the last change, even if the address was left before it was written, and can undo it', () => {
  const { composition, leave } = come({ utterance: 'A' })
  composition.insert(1, signPlace('B'))
  const again = leave({ utterance: 'A' }) // with the back key
  expect([said(again.composition), again.composition.address()]).toEqual(['A B', { utterance: 'A B' }])
  again.composition.undo()
  expect([said(again.composition), again.composition.canRedo]).toEqual(['A', true])
  again.composition.redo()
  again.composition.address()
  expect(said(again.leave({}).composition)).toBe('A B')
})

it('opens a link with different content', () => {
  const { composition, leave } = come({ utterance: 'A' })
  composition.insert(1, signPlace('B'))
  const other = leave({ utterance: 'C' }).composition
  expect([said(other), other.canUndo]).toEqual(['C', false])
  other.follow({ utterance: 'D' })
  other.undo()
  expect(said(other)).toBe('C')
})

it('keeps the unreadable text of a link, also in the address, until there is other content', () => {
  const { composition, wrong, leave } = come({ utterance: 'A "B' })
  expect([composition.unread, wrong, composition.address()]).toEqual(['A "B', ['utterance'], undefined])
  expect(leave({ utterance: 'A "B' }).composition.unread).toBe('A "B')
  composition.insert(0, signPlace('X'))
  expect([composition.unread, composition.address()]).toEqual(['A "B', { utterance: 'X' }])
  expect(leave({ utterance: 'X' }).composition.unread).toBe('A "B')
  composition.follow({ utterance: 'Y' })
  expect([composition.unread, said(composition)]).toEqual([undefined, 'Y'])
})

it("links to a project without the user's token", () => {
  const { composition } = come({ utterance: 'A' })
  expect(linkTo(composition.project, 'demo', 'https://x.org/studio/?token=SECRET#/demo/compose?utterance=B')).toBe(
    'https://x.org/studio/#/demo/compose?utterance=A',
  )
})
