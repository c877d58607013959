/** The actions of keys on phases; all other keys are the player's. */
export type PhaseAction =
  | 'before'
  | 'next'
  | 'nextOpen'
  | 'accept'
  | 'reject'
  | 'reopen'
  | 'acceptAll'
  | 'kind'
  | 'kindBack'
  | 'beginBack'
  | 'beginOn'
  | 'beginFarBack'
  | 'beginFarOn'
  | 'endBack'
  | 'endOn'
  | 'endFarBack'
  | 'endFarOn'
  | 'beginHere'
  | 'endHere'
  | 'split'
  | 'merge'
  | 'add'
  | 'undo'
  | 'redo'

/** One line of the help: the keys as printed, their actions in the same order, and the key of its message. */
export const kPhaseKeys = [
  { keys: ['↑', '↓'], actions: ['before', 'next'], text: 'key_walk' },
  { keys: ['N'], actions: ['nextOpen'], text: 'key_open' },
  { keys: ['Enter'], actions: ['accept'], text: 'key_accept' },
  { keys: ['Delete'], actions: ['reject'], text: 'key_reject' },
  { keys: ['U'], actions: ['reopen'], text: 'key_reopen' },
  { keys: ['Shift Enter'], actions: ['acceptAll'], text: 'key_acceptAll' },
  { keys: ['V', 'Shift V'], actions: ['kind', 'kindBack'], text: 'key_kind' },
  { keys: ['Q', 'W'], actions: ['beginBack', 'beginOn'], text: 'key_begin' },
  { keys: ['O', 'P'], actions: ['endBack', 'endOn'], text: 'key_end' },
  { keys: ['Shift Q', 'Shift W'], actions: ['beginFarBack', 'beginFarOn'], text: 'key_beginFar' },
  { keys: ['Shift O', 'Shift P'], actions: ['endFarBack', 'endFarOn'], text: 'key_endFar' },
  { keys: ['B', 'E'], actions: ['beginHere', 'endHere'], text: 'key_here' },
  { keys: ['X'], actions: ['split'], text: 'key_split' },
  { keys: ['M'], actions: ['merge'], text: 'key_merge' },
  { keys: ['A'], actions: ['add'], text: 'key_add' },
  { keys: ['Z', 'Y'], actions: ['undo', 'redo'], text: 'key_undo' },
] as const satisfies readonly { keys: readonly string[]; actions: readonly PhaseAction[]; text: string }[]

const kPrinted: Readonly<Record<string, string>> = { ArrowUp: '↑', ArrowDown: '↓', Backspace: 'Delete' }

/** Returns the action of a pressed key; undefined if it has none here. Without `characters`, only keys that type nothing have one. */
export function phaseActionOf(event: Pick<KeyboardEvent, 'key' | 'shiftKey' | 'ctrlKey' | 'altKey' | 'metaKey'>, characters = true): PhaseAction | undefined {
  const letter = event.key.length === 1 ? event.key.toUpperCase() : ''
  if ((event.ctrlKey || event.metaKey) && !event.altKey) return letter === 'Z' ? (event.shiftKey ? 'redo' : 'undo') : letter === 'Y' ? 'redo' : undefined
  if (event.ctrlKey || event.altKey || event.metaKey || (letter && !characters)) return undefined
  const printed = kPrinted[event.key] ?? (letter || event.key)
  const wanted = event.shiftKey && !['↑', '↓'].includes(printed) ? `Shift ${printed}` : printed
  for (const { keys, actions } of kPhaseKeys) {
    const at = (keys as readonly string[]).indexOf(wanted)
    if (at >= 0) return (actions as readonly PhaseAction[])[at]
  }
  return undefined
}
