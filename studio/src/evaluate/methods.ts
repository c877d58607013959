/** What a method is there for: to sign with, to be held against, or as a bound that nothing which signs can use. */
export type MethodKind = 'signing' | 'yardstick' | 'bound'
export interface Method {
  readonly method: string
  readonly kind: MethodKind
}

/** In the order of the command line, the default first. */
export const kMethods: readonly Method[] = [
  { method: 'taught', kind: 'signing' },
  { method: 'kriging', kind: 'signing' },
  { method: 'learned', kind: 'signing' },
  { method: 'recorded', kind: 'signing' },
  { method: 'quintic', kind: 'signing' },
  { method: 'hermite', kind: 'signing' },
  { method: 'inertialize', kind: 'signing' },
  { method: 'sine', kind: 'signing' },
  { method: 'gap', kind: 'signing' },
  { method: 'slerp', kind: 'yardstick' },
  { method: 'crossfade', kind: 'yardstick' },
  { method: 'recipe', kind: 'yardstick' },
  { method: 'hold', kind: 'yardstick' },
  { method: 'nearest', kind: 'bound' },
  { method: 'ceiling', kind: 'bound' },
]
const order = new Map(kMethods.map(({ method }, i) => [method, i]))

/** What can be asked for; slerp, which others are told over, and the bounds are always there. */
export const kChoice = kMethods.filter(({ kind }) => kind !== 'bound').map(({ method }) => method)
/** What can make captured frames anew. */
export const kRemaking = kMethods.filter(({ kind }) => kind === 'signing').map(({ method }) => method)

export const isBound = (method: string) => kMethods.some((one) => one.method === method && one.kind === 'bound')

/** The known ones in their order, then all others. */
export function inOrder(methods: readonly string[]): readonly string[] {
  return methods.toSorted((a, b) => (order.get(a) ?? 99) - (order.get(b) ?? 99) || a.localeCompare(b))
}
