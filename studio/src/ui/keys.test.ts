import { expect, it } from 'vitest'
import { en } from '../text/en'
import { fr } from '../text/fr'
import { actionOf, kKeys } from './keys'

const press = (key: string, more = {}) => actionOf({ key, code: '', shiftKey: false, ctrlKey: false, altKey: false, metaKey: false, ...more })

it('maps keys to actions, on French keyboards too', () => {
  expect(press(' ')).toBe('play')
  expect(press('ArrowRight', { shiftKey: true })).toBe('leapOn')
  expect(press('g')).toBe('select')
  expect(press('à', { code: 'Digit0' })).toBe('fit')
  expect(press('"', { code: 'Digit3' })).toBe('right')
  expect(press('?', { shiftKey: true })).toBe('help')
  expect(press('r', { ctrlKey: true })).toBeUndefined()
  expect(press('Tab')).toBeUndefined()
})

it('ignores character keys if they are switched off', () => {
  const event = (key: string) => ({ key, code: '', shiftKey: false, ctrlKey: false, altKey: false, metaKey: false })
  expect(['g', '?', '1', '+'].map((key) => actionOf(event(key), false))).toEqual([undefined, undefined, undefined, undefined])
  expect([' ', 'ArrowLeft', 'Escape', 'PageUp'].map((key) => actionOf(event(key), false))).toEqual(['play', 'back', 'clear', 'nearer'])
})

it('maps no key to two actions', () => {
  const all = kKeys.flatMap(({ keys }) => keys)
  expect(new Set(all).size).toBe(all.length)
  for (const { keys, actions } of kKeys) expect(keys.length).toBe(actions.length)
})

it('has every text in both languages, with the same placeholders', () => {
  for (const key of Object.keys(en) as (keyof typeof en)[]) {
    const holes = (text: string) => (text.match(/\{\w+\}/g) ?? []).sort()
    expect(holes(fr[key]), key).toEqual(holes(en[key]))
    expect(fr[key], key).not.toBe('')
  }
})
