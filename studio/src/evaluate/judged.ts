import type { Estimate, Judgement } from './evaluation'
import { inOrder } from './methods'

/** Whether a method may be the default, or why not: worse in a collection by more than its interval, or not better overall. */
export type Verdict = 'yes' | 'worse' | 'notBetter'
export interface JudgedRow {
  readonly method: string
  /** By collection, then overall. */ readonly cells: readonly (Estimate | undefined)[]
  readonly verdict: Verdict
}
export interface JudgedTable {
  /** The method of reference: kriging. */ readonly over: string
  /** Undefined if there is only one: the overall figure says the same. */ readonly collections: readonly string[]
  readonly rows: readonly JudgedRow[]
}

const known = (estimate: Estimate | undefined) => (typeof estimate?.value === 'number' ? estimate : undefined)

/** Returns wrist errors relative to another method's by collection; undefined if nothing was judged. */
export function judgedTable(judged: readonly Judgement[] | undefined): JudgedTable | undefined {
  if (!judged || judged.length === 0) return undefined
  const all = [...new Set(judged.flatMap(({ collections }) => collections.map(({ collection }) => collection)))]
  const collections = all.length > 1 ? all : []
  const rows = inOrder(judged.map(({ method }) => method)).map((method) => {
    const one = judged.find((of) => of.method === method)!
    const isWorse = one.collections.some(({ low }) => typeof low === 'number' && low > 1)
    return {
      method,
      cells: [...collections.map((name) => known(one.collections.find(({ collection }) => collection === name))), known(one.all)],
      verdict: one.may_be_default ? ('yes' as const) : isWorse ? ('worse' as const) : ('notBetter' as const),
    }
  })
  return { over: judged[0].over, collections, rows }
}

/** Returns the rows for `csvOf`, one per method; for each collection the figure, its interval and its number of spans. */
export function judgedCsv({ over, collections, rows }: JudgedTable): readonly (readonly (string | number | null | undefined)[])[] {
  const columns = [...collections, 'all'].flatMap((name) => [name, `${name} low`, `${name} high`, `${name} spans`])
  return [
    ['method', 'over', ...columns, 'may be the default'],
    ...rows.map(({ method, cells, verdict }) => [
      method,
      over,
      ...cells.flatMap((cell) => [cell?.value, cell?.low, cell?.high, cell?.spans]),
      verdict === 'yes' ? 'yes' : 'no',
    ]),
  ]
}
