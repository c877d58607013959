import type { TierChanges } from '../api/corpus_calls'
import type { Answer } from './answers'

/** Writes answers as the server's CSV. */
export function csvOf(answers: readonly Answer[], ranked: boolean, variables: readonly string[]): string {
  const matched = answers[0]?.match !== undefined
  const rows = [
    ['recording', 'tier', 'name', 'begin ms', 'end ms', ...(ranked ? ['distance'] : []), ...(matched ? ['match'] : []), ...variables],
    ...answers.map(({ recording, tier, name, begin, end, distance, match, bindings }) => [
      recording,
      tier,
      name,
      String(begin),
      String(end),
      ...(ranked ? [(distance ?? 0).toFixed(3)] : []),
      ...(match ? [match] : []),
      ...(bindings ?? []),
    ]),
  ]
  return rows.map((row) => row.map((field) => (/[",\r\n]/.test(field) ? `"${field.replaceAll('"', '""')}"` : field)).join(',') + '\n').join('')
}

/** Selects the wanted answers from the server's JSON; undefined if the database has changed meanwhile, so that they differ now. */
export function jsonOf(found: readonly object[], wanted: readonly Answer[]): string | undefined {
  const same = (one: Partial<Record<string, unknown>> | undefined, { recording, name, begin, end }: Answer) =>
    one !== undefined && one.recording === recording && one.name === name && one.begin_ms === begin && one.end_ms === end
  const rows = wanted.map((answer) => (same(found[answer.at] as Record<string, unknown>, answer) ? found[answer.at] : undefined))
  return rows.includes(undefined) ? undefined : JSON.stringify(rows, null, 2) + '\n'
}

/** Returns the file name for an answer's motion, valid on any system. */
export function fileName({ recording, name, begin, end }: Answer, extension: string): string {
  return `${plain(recording)}_${plain(name).slice(0, 60)}_${begin}-${end}.${extension}`
}
export function plain(text: string): string {
  return text.replace(/[\\/:*?"<>|\s\p{Cc}]+/gu, '-').replace(/^[-.]+|[-.]+$/g, '') || 'x'
}

/** Groups the answers by recording, in the order of first occurrence. */
export function byRecording(answers: readonly Answer[]): [recording: string, answers: Answer[]][] {
  const found = new Map<string, Answer[]>()
  for (const answer of answers) {
    const list = found.get(answer.recording)
    if (list) list.push(answer)
    else found.set(answer.recording, [answer])
  }
  return [...found]
}

/** The tiers that show answers in an annotation, as `signweave query --format eaf` names them: without overlaps on a tier. */
export function answerTier(answers: readonly Answer[]): NonNullable<TierChanges['tiers']>[number] {
  const annotations = answers.map(({ name: label, begin: begin_ms, end: end_ms }) => ({ begin_ms, end_ms, label }))
  return { name: 'query', type: 'query answers', spread: true, annotations }
}

/** Makes names unique. */
export function distinct(names: readonly string[]): string[] {
  const taken = new Set<string>()
  return names.map((name) => {
    let free = name
    for (let n = 2; taken.has(free); ++n) free = name.replace(/(\.[^.]*)?$/, ` (${n})$1`)
    taken.add(free)
    return free
  })
}

/** Saves a file through the browser. */
export function save(name: string, content: Blob): void {
  const link = document.createElement('a')
  link.href = URL.createObjectURL(content)
  link.download = name
  link.click()
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000)
}
