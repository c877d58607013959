import type { Text } from '../text/en'

/** The action of a key. */
export type Action =
  | 'play'
  | 'back'
  | 'on'
  | 'leapBack'
  | 'leapOn'
  | 'signBefore'
  | 'signAfter'
  | 'begin'
  | 'end'
  | 'slower'
  | 'faster'
  | 'repeat'
  | 'select'
  | 'loopBegin'
  | 'loopEnd'
  | 'clear'
  | 'front'
  | 'left'
  | 'right'
  | 'hands'
  | 'face'
  | 'whole'
  | 'orbitLeft'
  | 'orbitRight'
  | 'orbitUp'
  | 'orbitDown'
  | 'nearer'
  | 'farther'
  | 'trails'
  | 'bones'
  | 'signer'
  | 'zoomIn'
  | 'zoomOut'
  | 'fit'
  | 'full'
  | 'help'

/** One line of the help: the keys as printed, and their actions in the same order. */
export interface KeyRow {
  readonly keys: readonly string[]
  readonly actions: readonly Action[]
  readonly text: keyof Text
}

export const kKeys: readonly KeyRow[] = [
  { keys: ['Space'], actions: ['play'], text: 'key_play' },
  { keys: ['←', '→'], actions: ['back', 'on'], text: 'key_step' },
  { keys: ['Shift ←', 'Shift →'], actions: ['leapBack', 'leapOn'], text: 'key_leap' },
  { keys: ['↑', '↓'], actions: ['signBefore', 'signAfter'], text: 'key_signs' },
  { keys: ['Home', 'End'], actions: ['begin', 'end'], text: 'key_ends' },
  { keys: ['<', '>'], actions: ['slower', 'faster'], text: 'key_speed' },
  { keys: ['R'], actions: ['repeat'], text: 'key_repeat' },
  { keys: ['G'], actions: ['select'], text: 'key_select' },
  { keys: ['B', 'E'], actions: ['loopBegin', 'loopEnd'], text: 'key_bounds' },
  { keys: ['Esc'], actions: ['clear'], text: 'key_clear' },
  { keys: ['1', '2', '3', '4', '5', '6'], actions: ['front', 'left', 'right', 'hands', 'face', 'whole'], text: 'key_views' },
  { keys: ['J', 'L', 'I', 'K'], actions: ['orbitLeft', 'orbitRight', 'orbitUp', 'orbitDown'], text: 'key_orbit' },
  { keys: ['Page ↑', 'Page ↓'], actions: ['nearer', 'farther'], text: 'key_near' },
  { keys: ['T'], actions: ['trails'], text: 'key_trails' },
  { keys: ['S'], actions: ['bones'], text: 'key_bones' },
  { keys: ['C'], actions: ['signer'], text: 'key_signer' },
  { keys: ['+', '−'], actions: ['zoomIn', 'zoomOut'], text: 'key_zoom' },
  { keys: ['0'], actions: ['fit'], text: 'key_fit' },
  { keys: ['F'], actions: ['full'], text: 'key_full' },
  { keys: ['?'], actions: ['help'], text: 'key_help' },
]

const kPrinted: Readonly<Record<string, string>> = {
  ' ': 'Space',
  ArrowLeft: '←',
  ArrowRight: '→',
  ArrowUp: '↑',
  ArrowDown: '↓',
  Escape: 'Esc',
  PageUp: 'Page ↑',
  PageDown: 'Page ↓',
  '=': '+',
  '-': '−',
  h: '?',
  H: '?',
}

/** Returns the action of a pressed key; undefined if it has none here. Without `characters`, only Space and keys that type nothing have one. */
export function actionOf(event: Pick<KeyboardEvent, 'key' | 'code' | 'shiftKey' | 'ctrlKey' | 'altKey' | 'metaKey'>, characters = true): Action | undefined {
  if (event.ctrlKey || event.altKey || event.metaKey) return undefined
  if (!characters && event.key.length === 1 && event.key !== ' ') return undefined
  // Some keyboards require Shift for the row of digits, so the key's position counts there.
  const digit = /^Digit([0-6])$/.exec(event.code)?.[1]
  const printed = digit ?? kPrinted[event.key] ?? (event.key.length === 1 ? event.key.toUpperCase() : event.key)
  const wanted = event.shiftKey && event.key.startsWith('Arrow') ? `Shift ${printed}` : printed
  for (const { keys, actions } of kKeys) {
    const at = keys.indexOf(wanted)
    if (at >= 0) return actions[at]
  }
  return undefined
}

/** Whether a key belongs to the focused element: a text field, or a button or slider that uses it. */
export function belongsToFocus(event: KeyboardEvent): boolean {
  const target = event.target as HTMLElement | null
  if (!target) return false
  if (target.closest('dialog[open]')) return true
  if (target.matches('textarea, select, input:not([type=range]):not([type=checkbox]):not([type=radio])')) return true
  if (target.matches('input[type=range], input[type=radio]')) return /^(Arrow|Page|Home$|End$)/.test(event.key)
  return target.matches('button, a, summary, input') && (event.key === ' ' || event.key === 'Enter')
}
