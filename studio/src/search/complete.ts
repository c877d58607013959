import type { Labels, Vocabulary } from '../api/schema'
import { quoted } from './answers'
import { contextAfter, isCall, type Context } from './context'
import { kAngles, kComponentsOf, kMomentsOf, kNamesOf, kNumberOf, kRelations, kTextFields, kTimes, kZones } from './language'
import { scan, type Token } from './scan'

/** The vocabulary for completion; `tracks` are those of the face, `labels` those of the tiers requested so far. */
export type Words = Vocabulary & { readonly tracks?: readonly string[]; readonly labels?: ReadonlyMap<string, Labels['labels']> }

export interface Option {
  /** The label in the list. */
  readonly label: string
  /** The text that replaces what was typed. */
  readonly insert: string
  readonly kind: 'gloss' | 'label' | 'phase' | 'hand' | 'hands' | 'recording' | 'signer' | 'tier' | 'track' | 'word' | 'sign'
  /** For a gloss or label: its number of tokens. */
  readonly tokens?: number
}
export interface Completion {
  readonly from: number
  readonly to: number
  readonly options: readonly Option[]
  /** Whether the list may open by itself. */
  readonly eager: boolean
  /** A tier whose labels should be loaded. */
  readonly wants?: string
}

const kMost = 60
const kPlainFields = ['gloss', 'phase', 'hand', 'hands', 'recording', 'signer', 'tier', 'duration', 'begin', 'end', 'unit']

/** Returns what is valid at the caret and begins with or contains what was typed there. */
export function complete(text: string, caret: number, words: Words): Completion {
  const tokens = scan(text)
  const typing = tokens.find((token) => isTyped(token, caret))
  const before = tokens.filter(({ end }) => end <= (typing?.begin ?? caret))
  // There is no list for the content of a regular expression or a gap.
  if (typing && (typing.kind === 'regex' || typing.kind === 'gap')) return { from: caret, to: caret, options: [], eager: false }
  const context = contextAfter(before)
  const typed = typing ? text.slice(typing.begin, caret).replace(/^"/, '') : ''
  const from = typing?.begin ?? caret
  const to = typing ? endOf(typing, text, caret) : caret
  const rest = text.slice(to)
  const all = [...offered(context, words, rest, before), ...(typing && isWords(before, words) ? bareGlosses(words, typing) : [])]
  const options = matching(all, typed).map((option) => spaced(option, text, from, context))
  const done = text.slice(from, to)
  const only = typed !== '' && options.length === 1 && options[0].insert.trim() === done
  const wants =
    context.at === 'value' && context.by !== '=~' && context.tier !== undefined && words.tiers.includes(context.tier) && !words.labels?.has(context.tier)
  return {
    from,
    to,
    options: only ? [] : options,
    ...(wants ? { wants: context.tier } : {}),
    eager: typed !== '' || (typing !== undefined && typing.kind === 'text') || context.at === 'value' || context.at === 'argument',
  }
}

/** Whether all tokens are plain words outside the query language: the query is a search for words (docs/query.md). */
function isWords(before: readonly Token[], { language }: Words): boolean {
  const ofLanguage = (text: string) => [language.fields, language.functions, language.links].some((list) => list.includes(text))
  return before.every(({ kind, text }) => kind === 'text' || (kind === 'word' && !ofLanguage(text)))
}
function bareGlosses({ glosses }: Words, { kind }: Token): Option[] {
  const plain = (gloss: string) => kind === 'word' && /^[\p{L}\p{N}][\p{L}\p{N}'’-]*$/u.test(gloss)
  return glosses.map(({ gloss, tokens }): Option => ({ label: gloss, insert: plain(gloss) ? gloss : quoted(gloss), kind: 'gloss', tokens }))
}

/** Whether the caret is in a token being typed; after a symbol or a closed text it is not. */
function isTyped({ kind, begin, end, closed }: Token, caret: number): boolean {
  if (kind === 'symbol') return false
  if (kind === 'word' || kind === 'variable') return begin < caret && caret <= end
  return begin < caret && (caret < end || (caret === end && !closed))
}

/** Returns the end of the range that a choice overwrites: for an unclosed text, what follows the caret is preserved. */
function endOf({ kind, begin, end, closed }: Token, text: string, caret: number): number {
  if (kind !== 'text') return end
  const behind = text.slice(caret, closed ? end - 1 : end)
  return /[=&|()]|->/.test(behind) || text.slice(begin, end).includes('\n') ? caret : end
}

function offered(context: Context, words: Words, rest: string, before: readonly Token[]): readonly Option[] {
  switch (context.at) {
    case 'condition':
      return conditions(words, before)
    case 'compare': {
      const { fields, functions, links } = words.language
      return [fields, functions, links].some((list) => list.includes(context.of)) ? compares(context.of, context.part) : []
    }
    case 'value':
      return values(context, words)
    case 'argument':
      return argumentsOf(context.of, context.index, words, rest)
    case 'inner':
      return [sign(')')]
    case 'after':
      return after(context.open)
    case 'nothing':
      return []
  }
}

const word = (label: string, insert = label): Option => ({ label, insert, kind: 'word' })
const sign = (label: string, insert = label): Option => ({ label, insert, kind: 'sign' })

function conditions({ language }: Words, before: readonly Token[]): Option[] {
  const known = (name: string) => language.fields.includes(name)
  const fields = kPlainFields
    .filter(known)
    .map((name) => (name === 'unit' ? word(name) : name === 'tier' ? word(name, 'tier("') : word(name, `${name} ${kTimes.includes(name) ? '>' : '='} `)))
  const calls = [...language.functions.filter((name) => name !== 'like'), ...language.links].filter((name) => isCall(name) || kTimes.includes(name))
  const like = language.functions.includes('like') ? [word('like', 'like("')] : []
  const last = before[before.length - 1]
  const whole = last === undefined || last.text === '->' || last.kind === 'gap' ? [sign('@', '@ ')] : []
  return [...fields, ...like, ...calls.map((name) => word(kTimes.includes(name) ? `${name}(…)` : name, `${name}(`)), sign('!'), sign('('), ...whole]
}

function compares(of: string, part?: string): Option[] {
  // A function needs its parenthesis, and after it some functions require or allow a component.
  if (part === undefined && isCall(of)) return [sign('(')]
  if (part === '' && of in kComponentsOf) return kComponentsOf[of].map((name) => word(name))
  const moments = part === '' ? (kMomentsOf[of] ?? []) : []
  const named = part === '.palm' || part === '.fingers' || part === '.x' || part === '.forward'
  const signs =
    kTextFields.includes(of) || of === 'tier'
      ? ['=', '!=', ...(of === 'hand' || of === 'hands' ? [] : ['=~'])]
      : of === 'contact' || of === 'enters' || part === '.contact'
        ? ['=']
        : part === '.palm' || part === '.fingers'
          ? ['=', '!=']
          : ['>', '<', '>=', '<=', ...(named || part === '.height' || (part === undefined && kTimes.includes(of)) ? ['=', '!='] : [])]
  return [...signs.map((one) => sign(one, `${one} `)), ...moments.map((name) => word(name))]
}

function values({ of, by, part, tier }: Context & { readonly at: 'value' }, words: Words): readonly Option[] {
  if (by === '=~') return [sign('/…/', '/')]
  const { language } = words
  const texts = (list: readonly string[], kind: Option['kind']) => list.map((label): Option => ({ label, insert: quoted(label), kind }))
  const plain = (list: readonly string[], kind: Option['kind']) => list.map((label): Option => ({ label, insert: label, kind }))
  switch (of) {
    case 'gloss':
      return [...words.glosses.map(({ gloss, tokens }): Option => ({ label: gloss, insert: quoted(gloss), kind: 'gloss', tokens })), sign('$X')]
    case 'phase':
      return plain(language.phases, 'phase')
    case 'hand':
      return plain(language.hands, 'hand')
    case 'hands':
      return plain(language.two_handed, 'hands')
    case 'recording':
      return texts(words.recordings, 'recording')
    case 'signer':
      return texts(words.signers, 'signer')
    case 'tier': {
      const labels = words.labels
        ?.get(tier ?? '')
        ?.map(({ label, annotations }): Option => ({ label, insert: quoted(label), kind: 'label', tokens: annotations }))
      return [...(labels ?? [sign('"…"', '"')]), sign('$X')]
    }
  }
  const what = part && (part in kNumberOf || part in kNamesOf) ? part : of
  return [...(what in kNumberOf && of !== 'enters' ? [sign(kNumberOf[what])] : []), ...(kNamesOf[what] ?? []).map((name) => word(name))]
}

function argumentsOf(of: string, index: number, words: Words, rest: string): readonly Option[] {
  const end = /^\s*[,)]/.test(rest) ? '' : ')'
  const closing = (list: readonly string[], kind: Option['kind'], write = (one: string) => one, last = end) =>
    list.map((label): Option => ({ label, insert: write(label) + last, kind }))
  switch (of) {
    case 'tier':
      return closing(words.tiers, 'tier', quoted)
    case 'track':
    case 'mean_track':
      return closing(words.tracks ?? [], 'track')
    case 'gaze':
    case 'mean_gaze':
      return closing(kAngles, 'word')
    case 'like':
      return index > 0 ? closing(words.language.points, 'word') : closing(words.recordings, 'recording', quoted, /^\s*@/.test(rest) ? '' : '@')
    case 'enters':
      return index > 0 ? closing(kZones, 'word') : closing(words.language.points, 'word', undefined, end ? ', ' : end)
    case 'max':
    case 'min':
    case 'any':
      return [...closing(words.language.points, 'word'), ...Object.keys(kMomentsOf).map((name) => word(`${name}(…)`, `${name}(`))]
    case 'distance':
      return closing(words.language.points, 'word', undefined, index === 0 && end ? ', ' : end)
  }
  return words.language.functions.includes(of) ? closing(words.language.points, 'word') : []
}

function after(open: number): Option[] {
  return [
    sign('&', '& '),
    sign('|', '| '),
    sign('->', '-> '),
    sign('->[..]', '->[..500ms] '),
    ...kRelations.map((name) => word(name, `${name} `)),
    ...(open > 0 ? [sign(')')] : []),
  ]
}

/** Options that begin with what was typed, then those that contain it; accents and case are ignored. */
function matching(options: readonly Option[], typed: string): Option[] {
  const wanted = folded(typed)
  if (!wanted) return options.slice(0, kMost)
  const first: Option[] = [],
    then: Option[] = []
  for (const option of options) {
    const at = folded(option.label).indexOf(wanted)
    if (at === 0) first.push(option)
    else if (at > 0 && option.kind !== 'sign') then.push(option)
  }
  return [...first, ...then].slice(0, kMost)
}
const folded = (text: string) => text.normalize('NFD').replace(/\p{M}/gu, '').toLowerCase()

/** Adds a space in front if it would join a comparison or a word. */
function spaced(option: Option, text: string, from: number, context: Context): Option {
  const sticks = from > 0 && !/[\s(!]/.test(text[from - 1]) && context.at !== 'argument' && !option.insert.startsWith('.') && option.insert !== '('
  return sticks ? { ...option, insert: ` ${option.insert}` } : option
}
