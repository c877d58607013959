// @vitest-environment jsdom
import { afterEach, beforeEach, expect, it, vi } from 'vitest'
import { FileDrag, isOfFiles } from './file_drag.svelte'

beforeEach(() => void vi.useFakeTimers())
afterEach(() => void vi.useRealTimers())
const leaving = (relatedTarget: Node | null) => ({ relatedTarget }) as unknown as DragEvent
const dragging = (...types: string[]) => ({ dataTransfer: { types } }) as unknown as DragEvent

it('distinguishes files of the disk from text, links and pictures of a page', () => {
  expect(isOfFiles(dragging('Files'))).toBe(true)
  expect(isOfFiles(dragging('text/plain'))).toBe(false)
  expect(isOfFiles(dragging('text/uri-list', 'text/html', 'Files'))).toBe(false)
  expect(isOfFiles({ dataTransfer: null } as DragEvent)).toBe(false)
})
it('lasts while descendants are entered and left, and ends when the whole is left', () => {
  const drag = new FileDrag(),
    child = document.body.appendChild(document.createElement('p'))
  drag.here()
  drag.left(leaving(child), document)
  expect(drag.over).toBe(true)
  drag.left(leaving(null), document)
  expect(drag.over).toBe(false)
})
it('ends when no more drag events arrive', () => {
  const drag = new FileDrag()
  drag.here()
  vi.advanceTimersByTime(900)
  drag.here()
  vi.advanceTimersByTime(900)
  expect(drag.over).toBe(true)
  vi.advanceTimersByTime(200)
  expect(drag.over).toBe(false)
})
