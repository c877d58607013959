import type { Estimate } from './evaluation'
import { figureOf, type Hand, type Task, type Group } from './evaluation'
import { bestOf, columnName, methodsIn, type Better, type Measure } from './measures'
import { inOrder, isBound } from './methods'

/** One column of figures: its measure, and how it is rated. */
export interface Column {
  readonly key: string
  readonly digits: number
  readonly better: Better
  readonly unit?: string
}
export interface Row {
  readonly method: string
  readonly cells: readonly (Estimate | undefined)[]
}
/** Methods against measures or groups. */
export interface FigureTable {
  readonly columns: readonly Column[]
  readonly rows: readonly Row[]
  /** The best methods of each column. */ readonly best: readonly ReadonlySet<string>[]
}
/** The column to sort by; −1 for the methods' own order. */
export interface Sorting {
  readonly column: number
  readonly down: boolean
}

function tableOf(methods: readonly string[], columns: readonly Column[], cell: (method: string, column: number) => Estimate | undefined): FigureTable {
  const rows = inOrder([...new Set(methods)])
    .map((method) => ({ method, cells: columns.map((_, i) => cell(method, i)) }))
    .filter(({ cells }) => cells.some(Boolean))
  return {
    columns,
    rows,
    best: columns.map(({ better }, i) =>
      bestOf(
        rows.map(({ method, cells }) => [method, cells[i]]),
        better,
        isBound,
      ),
    ),
  }
}

/** Returns one measure of one hand, with a column for each group. */
export function tableByGroup(groups: readonly Group[], hand: Hand, measure: Measure): FigureTable {
  const columns = groups.map(({ group }) => ({ ...measure, key: group }))
  return tableOf(
    groups.flatMap(({ hands }) => methodsIn(hands[hand])),
    columns,
    (method, i) => figureOf(groups[i].hands[hand], method, measure.measure),
  )
}

/** Returns all measures of one hand in one group, without those that have no figures. */
export function tableByMeasure(group: Group, hand: Hand, measures: readonly Measure[]): FigureTable {
  const scores = group.hands[hand]
  const there = measures.filter(({ measure }) => methodsIn(scores).some((method) => figureOf(scores, method, measure)))
  return tableOf(
    methodsIn(scores),
    there.map((one) => ({ ...one, key: one.measure })),
    (method, i) => figureOf(scores, method, there[i].measure),
  )
}

/** Rows without a figure come last, in either direction. */
export function sorted(table: FigureTable, { column, down }: Sorting): readonly Row[] {
  if (column < 0 || column >= table.columns.length) return down ? table.rows.toReversed() : table.rows
  const of = (row: Row) => row.cells[column]?.value
  return table.rows.toSorted((a, b) => {
    const x = of(a),
      y = of(b)
    if (typeof x !== 'number' || typeof y !== 'number') return Number(typeof x !== 'number') - Number(typeof y !== 'number')
    return down ? y - x : x - y
  })
}

/** Returns the rows for `csvOf`, one per method; for each column the figure, its interval and its sample size. `known` is prepended to each row. */
export function csvRows(
  table: FigureTable,
  rows: readonly Row[],
  known: Readonly<Record<string, string>>,
): readonly (readonly (string | number | null | undefined)[])[] {
  const names = table.columns.flatMap(({ key, unit }) => {
    const name = columnName(key) + (unit ? ` (${unit})` : '')
    return [name, `${name} low`, `${name} high`, `${name} spans`]
  })
  return [
    [...Object.keys(known), 'method', ...names],
    ...rows.map(({ method, cells }) => [...Object.values(known), method, ...cells.flatMap((cell) => [cell?.value, cell?.low, cell?.high, cell?.spans])]),
  ]
}

/** Returns a task's counts of spans and recordings, and the error of the durations, which is the same for all methods. */
export function countsOf(
  task: Task,
  durations: readonly Measure[],
): readonly { readonly group: Group; readonly durations: readonly (Estimate | undefined)[] }[] {
  return task.groups.map((group) => {
    const scores = group.hands.moving
    const [any] = methodsIn(scores)
    return { group, durations: durations.map(({ measure }) => (any ? figureOf(scores, any, measure) : undefined)) }
  })
}
