import { expect, it } from 'vitest'
import { fr } from '../text/fr'
import { captionOf, linesOf } from './caption'

it('a caption contains each part once, and says if the face is neutral', () => {
  expect(captionOf({ a: 'shapes', b: 'shapes' }, true)).toEqual(['shapes'])
  expect(captionOf({ a: 'shapes' }, false, ['a drawn body'])).toEqual(['shapes', 'No face captured: the face is neutral', 'a drawn body'])
  expect(captionOf({}, true)).toEqual([])
  expect(captionOf({}, false, [], fr)).toEqual(['Visage non capté\u202f: il reste neutre'])
})

it('a caption that is too wide continues on further lines, and loses no word', () => {
  const measure = (text: string) => text.length
  expect(linesOf(['one', 'two'], 20, measure)).toEqual(['one  ·  two'])
  expect(linesOf(['one two', 'three'], 12, measure)).toEqual(['one two', 'three'])
  expect(linesOf(['a long sentence of words'], 10, measure)).toEqual(['a long', 'sentence', 'of words'])
  expect(linesOf(['unbreakable'], 4, measure)).toEqual(['unbreakable'])
  expect(linesOf([], 4, measure)).toEqual([])
})
