/** The purpose of a method: signing, comparison, or a bound based on data that is not available when signing. */
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

/** The methods that can be selected; slerp, the reference, and the bounds are always included. */
export const kChoice = kMethods.filter(({ kind }) => kind !== 'bound').map(({ method }) => method)
/** The methods that can regenerate captured frames. */
export const kRegenerating = kMethods.filter(({ kind }) => kind === 'signing').map(({ method }) => method)

export const isBound = (method: string) => kMethods.some((one) => one.method === method && one.kind === 'bound')

/** Sorts methods: the known ones in their order, then all others. */
export function inOrder(methods: readonly string[]): readonly string[] {
  return methods.toSorted((a, b) => (order.get(a) ?? 99) - (order.get(b) ?? 99) || a.localeCompare(b))
}
