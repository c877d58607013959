import { readFrames, type FrameTaker } from '../motion/frames_body'
import type { Database, FileFormat, JobBegun, Proposals, Recording } from './schema'
import { faultOf, path, query, type Api } from './client'
import { StudioFault } from './fault'

/** Changes of an annotation, as docs/http.md describes them. */
export interface TierChanges {
  readonly remove?: readonly string[]
  readonly tiers?: readonly {
    readonly name: string
    readonly type: string
    readonly annotator?: string
    readonly participant?: string
    readonly spread?: boolean
    readonly annotations: readonly { readonly begin_ms: number; readonly end_ms: number; readonly label: string }[]
  }[]
  readonly properties?: readonly { readonly name: string; readonly value: string }[]
}

/// Calls that fill and change a database, and calls that report how it is stored.

export const formats = (api: Api): Promise<readonly FileFormat[]> => api.json('formats')
export const databaseInfo = (api: Api, database: string): Promise<Database> => api.json(path('databases', database))
export const storedRecording = (api: Api, database: string, recording: string): Promise<Recording> =>
  api.json(path('databases', database, 'recordings', recording))
export const proposals = (api: Api, database: string, recording: string, signal?: AbortSignal): Promise<Proposals> =>
  api.json(path('databases', database, 'recordings', recording, 'segment'), { signal })
/** Returns a recording's annotation with changes, as an EAF file; nothing is stored. Fails if it has another annotation than that of fingerprint `over`. */
export async function annotated(api: Api, database: string, recording: string, changes: TierChanges, signal?: AbortSignal, over?: string): Promise<Blob> {
  const where = path('databases', database, 'recordings', recording, 'annotation') + query({ if_annotation: over })
  return (await api.post(where, changes, signal)).blob()
}

export async function openUpload(api: Api, database: string): Promise<string> {
  return (await api.json<{ upload: string }>(path('databases', database, 'uploads'), { method: 'POST' })).upload
}
export async function discardUpload(api: Api, database: string, upload: string): Promise<void> {
  await api.call(path('databases', database, 'uploads', upload), { method: 'DELETE', keepalive: true }) // also sent while the window closes
}
/** Removes a file from an upload. */
export async function removeUploaded(api: Api, database: string, upload: string, file: string): Promise<void> {
  await api.call(path('databases', database, 'uploads', upload, 'files', file), { method: 'DELETE' })
}
/** Starts a job on an upload; `body` holds the parameters of an import. */
export async function beginUpload(api: Api, database: string, upload: string, call: 'inspect' | 'import', body: object): Promise<JobBegun> {
  return (await api.post(path('databases', database, 'uploads', upload, call), body)).json() as Promise<JobBegun>
}
/** Fetches part of a file's motion as an import would store it; `body` holds the parameters of an import and `file`. */
export async function previewUpload(api: Api, database: string, upload: string, body: object, taker: FrameTaker, signal?: AbortSignal): Promise<void> {
  const response = await api.post(path('databases', database, 'uploads', upload, 'preview'), body, signal)
  await readFrames(response.body!, taker)
}
export async function relayout(api: Api, database: string, body: object): Promise<JobBegun> {
  return (await api.post(path('databases', database, 'relayout'), body)).json() as Promise<JobBegun>
}
export async function cancelJob(api: Api, job: string): Promise<void> {
  await api.call(path('jobs', job), { method: 'DELETE', keepalive: true })
}
export async function removeRecording(api: Api, database: string, recording: string): Promise<void> {
  await api.call(path('databases', database, 'recordings', recording), { method: 'DELETE' })
}
/** Returns whether the database may be changed. */
export async function isWritable(api: Api, database: string): Promise<boolean> {
  return (await api.databases()).find(({ name }) => name === database)?.writable ?? false
}

/** Sends a file under its plain name and reports the number of bytes sent, which `fetch` cannot do. Rejects with the signal's reason if aborted. */
export function sendFile(
  api: Api,
  database: string,
  upload: string,
  name: string,
  file: Blob,
  onprogress: (bytes: number) => void,
  signal: AbortSignal,
): Promise<void> {
  const { url, headers } = api.request(path('databases', database, 'uploads', upload, 'files', name))
  return new Promise((resolve, reject) => {
    if (signal.aborted) return reject(signal.reason)
    const request = new XMLHttpRequest()
    const stop = () => request.abort()
    signal.addEventListener('abort', stop, { once: true })
    request.upload.onprogress = ({ loaded }) => onprogress(loaded)
    request.onabort = () => reject(signal.reason)
    request.onerror = () => reject(new StudioFault('unreachable'))
    request.onload = () => (request.status < 300 ? resolve() : reject(faultOf(request.responseText, request.status)))
    request.onloadend = () => signal.removeEventListener('abort', stop)
    request.open('PUT', url)
    for (const [header, value] of Object.entries(headers)) request.setRequestHeader(header, value)
    request.send(file)
  })
}
