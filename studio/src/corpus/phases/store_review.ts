import type { JobBegun } from '../../api/answers'
import type { Imported, ImportResult, Inspected, Inspection } from '../../api/corpus_answers'
import type { Api } from '../../api/client'
import { beginUpload, cancelJob, discardUpload, openUpload, sendFile } from '../../api/corpus_calls'
import { encoded } from '../../annotation/xml_text'
import { isPlain } from '../import/file_kinds'
import { tableOf } from '../import/pairs'
import type { Written } from './checked_tiers'

const kTable = 'pairs.csv'

/** Which tiers the phases of signs come from: a choice, and the tiers that it means. */
export interface PhaseChoice {
  readonly kind: 'now' | 'right' | 'left' | 'both'
  readonly tiers: readonly string[]
}

/**
 * What can be chosen, the best first; none where there are no signs. Tiers that were in use stay so where they are others than the checked ones; else the
 * hand that does more, for a sign of both hands would have the phases of both, one over the other. Signs with a tier for each hand take both.
 */
export function choicesOf(report: Inspected, written: Written['tiers']): readonly PhaseChoice[] {
  const signs = report.tiers?.filter(({ role }) => role === 'signs') ?? []
  if (signs.length === 0) return []
  const ours = written.map(({ name }) => name)
  const taken = report.tiers?.filter(({ role }) => role === 'phases').map(({ tier }) => tier) ?? []
  const now = taken.filter((tier) => !ours.includes(tier))
  const hands = [...written]
    .sort((a, b) => Number(taken.includes(b.name)) - Number(taken.includes(a.name)) || b.count - a.count)
    .map(({ hand, name }): PhaseChoice => ({ kind: hand, tiers: [name] }))
  const both: readonly PhaseChoice[] = ours.length > 1 ? [{ kind: 'both', tiers: ours }] : []
  const own = now.length > 0 ? [{ kind: 'now' as const, tiers: now }] : []
  return signs.every(({ hand }) => hand !== 'both') && signs.length > 1 ? [...own, ...both, ...hands] : [...own, ...hands, ...both]
}

/** Whether a choice is what the server would do without being told. */
export function isTold(report: Inspected, { tiers }: PhaseChoice): boolean {
  const taken = report.tiers?.filter(({ role }) => role === 'phases').map(({ tier }) => tier) ?? []
  return taken.length === tiers.length && tiers.every((tier) => taken.includes(tier))
}

/** A document that lies with the server, ready to be stored; `body` says which recording it is of. */
export interface Sent {
  readonly upload: string
  readonly body: object
  readonly report: Inspected | undefined
}

/** The name that a recording's document is sent under, and the table that says which recording it is of where that name does not. */
export function filesFor(recording: string): { readonly file: string; readonly table?: string } {
  if (isPlain(`${recording}.eaf`)) return { file: `${recording}.eaf` }
  // A folder in front, or what no file may be called.
  const last = `${recording.split('/').at(-1)}.eaf`,
    file = isPlain(last) ? last : 'review.eaf'
  return { file, table: tableOf([{ motion: null, annotation: file, face: null, signer: '', name: recording }]) }
}

/** Sends the document alone, and has it looked at. */
export async function sendReview(api: Api, database: string, recording: string, text: string, signal: AbortSignal): Promise<Sent> {
  const upload = await openUpload(api, database)
  const { file, table } = filesFor(recording),
    body = table ? { pairs: kTable } : {}
  let job: JobBegun | undefined
  try {
    await sendFile(api, database, upload, file, new Blob([encoded(text)]), () => {}, signal)
    if (table) await sendFile(api, database, upload, kTable, new Blob([table]), () => {}, signal)
    job = await beginUpload(api, database, upload, 'inspect', body)
    const { recordings } = await api.result<Inspection>(job, () => {}, signal)
    return { upload, body, report: recordings[0] }
  } catch (fault) {
    // A server has room for a few uploads only; one that is still looked at cannot be given up before that ends.
    if (job) {
      await cancelJob(api, job.job).catch(() => {})
      await api.result(job).catch(() => {})
    }
    await discardUpload(api, database, upload).catch(() => {})
    throw fault
  }
}
/** Stores what was sent: it takes the place of the recording's annotation where that is still `over`. */
export async function storeSent(
  api: Api,
  database: string,
  { upload, body: about, report }: Sent,
  choice: PhaseChoice | undefined,
  over: string,
): Promise<Imported> {
  const body = { ...about, if_annotation: over, ...(choice && report && !isTold(report, choice) ? { phase_tier: choice.tiers } : {}) }
  const { recordings } = await api.result<ImportResult>(await beginUpload(api, database, upload, 'import', body))
  return recordings[0]
}
export function forgetSent(api: Api, database: string, sent: Sent | undefined): void {
  if (sent) discardUpload(api, database, sent.upload).catch(() => {}) // it goes by itself when nobody uses it
}
