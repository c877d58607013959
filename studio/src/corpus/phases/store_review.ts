import type { ImportResult, ImportedReply, InspectResult, InspectedRecording, JobBegun } from '../../api/schema'
import type { Api } from '../../api/client'
import { beginUpload, cancelJob, discardUpload, openUpload, sendFile } from '../../api/corpus_calls'
import { isPlain } from '../import/file_kinds'
import { tableOf } from '../import/pairs'
import type { Written } from './checked_tiers'

const kTable = 'pairs.csv'

/** A choice of the tiers from which the phases of signs are taken. */
export interface PhaseChoice {
  readonly kind: 'now' | 'right' | 'left' | 'both'
  readonly tiers: readonly string[]
}

/**
 * Returns the choices, best first; empty if there are no signs. Tiers in use other than the checked ones come first; otherwise the hand with more phases,
 * because with both hands a two-handed sign would have overlapping phases of both. Signs with a tier for each hand take both.
 */
export function choicesOf(report: InspectedRecording, written: Written['tiers']): readonly PhaseChoice[] {
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

/** Whether a choice is what the server does by default. */
export function isDefault(report: InspectedRecording, { tiers }: PhaseChoice): boolean {
  const taken = report.tiers?.filter(({ role }) => role === 'phases').map(({ tier }) => tier) ?? []
  return taken.length === tiers.length && tiers.every((tier) => taken.includes(tier))
}

/** A document on the server, ready to be stored; `body` identifies its recording. */
export interface Sent {
  readonly upload: string
  readonly body: object
  readonly report: InspectedRecording | undefined
}

/** Returns the name under which a recording's document is sent, and a table that names the recording if the file name does not. */
export function filesFor(recording: string): { readonly file: string; readonly table?: string } {
  if (isPlain(`${recording}.eaf`)) return { file: `${recording}.eaf` }
  // The name contains a folder, or characters that are not allowed in file names.
  const last = `${recording.split('/').at(-1)}.eaf`,
    file = isPlain(last) ? last : 'review.eaf'
  return { file, table: tableOf([{ motion: null, annotation: file, face: null, signer: '', name: recording }]) }
}

/** Sends only the document, and has it inspected. */
export async function sendReview(api: Api, database: string, recording: string, annotation: Blob, signal: AbortSignal): Promise<Sent> {
  const upload = await openUpload(api, database)
  const { file, table } = filesFor(recording),
    body = table ? { pairs: kTable } : {}
  let job: JobBegun | undefined
  try {
    await sendFile(api, database, upload, file, annotation, () => {}, signal)
    if (table) await sendFile(api, database, upload, kTable, new Blob([table]), () => {}, signal)
    job = await beginUpload(api, database, upload, 'inspect', body)
    const { recordings } = await api.result<InspectResult>(job, () => {}, signal)
    return { upload, body, report: recordings[0] }
  } catch (fault) {
    // A server holds only a few uploads; one under inspection cannot be discarded before that ends.
    if (job) {
      await cancelJob(api, job.job).catch(() => {})
      await api.result(job).catch(() => {})
    }
    await discardUpload(api, database, upload).catch(() => {})
    throw fault
  }
}
/** Stores the sent document: it replaces the recording's annotation if that is still `over`. */
export async function storeSent(
  api: Api,
  database: string,
  { upload, body: about, report }: Sent,
  choice: PhaseChoice | undefined,
  over: string,
): Promise<ImportedReply> {
  const body = { ...about, if_annotation: over, ...(choice && report && !isDefault(report, choice) ? { phase_tier: choice.tiers } : {}) }
  const { recordings } = await api.result<ImportResult>(await beginUpload(api, database, upload, 'import', body))
  return recordings[0]
}
export function forgetSent(api: Api, database: string, sent: Sent | undefined): void {
  if (sent) discardUpload(api, database, sent.upload).catch(() => {}) // the server removes it after a time without use
}
