import { kMomentsOf, kOverMoments, kRelations, kTextFields, kTimes } from './language'
import type { Token } from './scan'

/** What is valid at the end of what was typed. */
export type Context =
  | { readonly at: 'condition' }
  /** `of` is the field or function; `tier` the name in the parentheses of `tier`, `part` the component after a function. */
  | { readonly at: 'compare'; readonly of: string; readonly part?: string; readonly tier?: string }
  | { readonly at: 'value'; readonly of: string; readonly by: string; readonly part?: string; readonly tier?: string }
  /** `inner` is the quantity named in max(…) and the like. */
  | { readonly at: 'argument'; readonly of: string; readonly index: number; readonly inner?: string }
  /** The quantity `of` in max(…) and the like is complete. */
  | { readonly at: 'inner'; readonly of: string }
  /** A condition is complete. `open` counts parentheses. */
  | { readonly at: 'after'; readonly open: number }
  | { readonly at: 'nothing' }

const kCompare = /^(=|!=|=~|<|<=|>|>=)$/
const kLinks: readonly string[] = ['parent', 'child', 'ancestor', 'descendant', ...kRelations]

/** Reads tokens from the begin of a query, and returns what is valid next. */
export function contextAfter(tokens: readonly Token[]): Context {
  let here: Context = { at: 'condition' }
  /** The owner of each open parenthesis: a group or a link, otherwise the function's name. */
  const open: string[] = []
  let tier: string | undefined
  for (const token of tokens) {
    const { text } = token
    const symbol = token.kind === 'symbol'
    if (symbol && (text === '&' || text === '|' || text === '->')) here = { at: 'condition' }
    else if (symbol && text === ')') here = closed(open.pop(), open, tier, here)
    else if (symbol && text === '(' && here.at === 'argument' && here.inner) {
      open.push(here.inner)
      here = { at: 'argument', of: here.inner, index: 0 }
    } else if (symbol && text === '(') {
      const of: string = here.at === 'compare' ? here.of : ''
      const call = of !== '' && !kLinks.includes(of)
      open.push(call ? of : '')
      tier = undefined
      here = call ? { at: 'argument', of, index: 0 } : { at: 'condition' }
    } else if (symbol && kCompare.test(text))
      here = here.at === 'compare' ? { at: 'value', of: here.of, by: text, part: here.part, tier: here.tier } : { at: 'nothing' }
    else if (symbol && text === ',') here = here.at === 'argument' ? { at: 'argument', of: here.of, index: here.index + 1 } : here
    else if (here.at === 'argument' && here.of === 'tier') tier = text
    else if (here.at === 'argument' && kOverMoments.includes(here.of) && Object.hasOwn(kMomentsOf, text))
      here = { at: 'argument', of: here.of, index: here.index, inner: text }
    else if (here.at === 'condition') here = begun(here, token, open)
    else if (here.at === 'value') here = { at: 'after', open: open.length }
    else if (here.at === 'after' && token.kind === 'word' && kRelations.includes(text)) here = { at: 'condition' }
    else if (here.at === 'compare' && text.startsWith('.')) here = { at: 'compare', of: here.of, part: text }
  }
  return here
}

/** After the first token of a condition. */
function begun(here: Context, { kind, text }: Token, open: readonly string[]): Context {
  if (kind === 'gap' || (kind === 'symbol' && (text === '!' || text === '@'))) return here
  if (kind !== 'word') return { at: 'nothing' }
  if (text === 'unit') return { at: 'after', open: open.length }
  return { at: 'compare', of: text }
}

/** After a closing parenthesis. */
function closed(of: string | undefined, open: readonly string[], tier: string | undefined, here: Context): Context {
  if (of === undefined) return { at: 'nothing' }
  if (kOverMoments.includes(open[open.length - 1])) return { at: 'inner', of }
  // max(speed(hand)) is a single value: no component may follow.
  if (here.at === 'inner') return { at: 'compare', of: here.of, part: of === 'max' ? '.most' : '.least', tier }
  const zone = of === 'enters' && here.at === 'argument' && here.index > 0
  return of === '' || of === 'like' || zone ? { at: 'after', open: open.length } : { at: 'compare', of, part: '', tier }
}

/** Whether a word needs a parenthesis, as functions and links do. */
export function isCall(word: string): boolean {
  return !kTextFields.includes(word) && !kTimes.includes(word) && word !== 'unit'
}
