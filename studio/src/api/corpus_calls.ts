import { readFrames, type FrameTaker } from '../motion/frames_body'
import type { JobBegun } from './answers'
import { faultOf, path, type Api } from './client'
import type { DatabaseInfo, FormatRow, Proposals, StoredRecording } from './corpus_answers'
import { StudioFault } from './fault'

/// The calls that fill and change a database, and those that tell how it is stored.

export const formats = (api: Api): Promise<readonly FormatRow[]> => api.json('formats')
export const databaseInfo = (api: Api, database: string): Promise<DatabaseInfo> => api.json(path('databases', database))
export const storedRecording = (api: Api, database: string, recording: string): Promise<StoredRecording> =>
  api.json(path('databases', database, 'recordings', recording))
export const proposals = (api: Api, database: string, recording: string, signal?: AbortSignal): Promise<Proposals> =>
  api.json(path('databases', database, 'recordings', recording, 'segment'), { signal })
/** The annotation's bytes, in whatever encoding it was stored. */
export async function annotationBytes(api: Api, database: string, recording: string, signal?: AbortSignal): Promise<ArrayBuffer> {
  return (await api.call(path('databases', database, 'recordings', recording, 'annotation'), { signal })).arrayBuffer()
}

export async function openUpload(api: Api, database: string): Promise<string> {
  return (await api.json<{ upload: string }>(path('databases', database, 'uploads'), { method: 'POST' })).upload
}
export async function discardUpload(api: Api, database: string, upload: string): Promise<void> {
  await api.call(path('databases', database, 'uploads', upload), { method: 'DELETE', keepalive: true }) // also where the window goes
}
/** Takes a file out of an upload. */
export async function removeUploaded(api: Api, database: string, upload: string, file: string): Promise<void> {
  await api.call(path('databases', database, 'uploads', upload, 'files', file), { method: 'DELETE' })
}
/** Begins a job on an upload: `body` has the parameters of an import. */
export async function beginUpload(api: Api, database: string, upload: string, call: 'inspect' | 'import', body: object): Promise<JobBegun> {
  return (await api.post(path('databases', database, 'uploads', upload, call), body)).json() as Promise<JobBegun>
}
/** A piece of a file's motion as an import would store it: `body` has the parameters of an import, and `file`. */
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
/** Whether the database may be changed. */
export async function isWritable(api: Api, database: string): Promise<boolean> {
  return (await api.databases()).find(({ name }) => name === database)?.writable ?? false
}

/**
 * Sends a file under its plain name, and tells how many of its bytes have gone; `fetch` does not tell that. Rejects with the signal's reason where it is
 * given up.
 */
export function sendFile(
  api: Api,
  database: string,
  upload: string,
  name: string,
  file: Blob,
  told: (bytes: number) => void,
  signal: AbortSignal,
): Promise<void> {
  const { url, headers } = api.request(path('databases', database, 'uploads', upload, 'files', name))
  return new Promise((resolve, reject) => {
    if (signal.aborted) return reject(signal.reason)
    const request = new XMLHttpRequest()
    const stop = () => request.abort()
    signal.addEventListener('abort', stop, { once: true })
    request.upload.onprogress = ({ loaded }) => told(loaded)
    request.onabort = () => reject(signal.reason)
    request.onerror = () => reject(new StudioFault('unreachable'))
    request.onload = () => (request.status < 300 ? resolve() : reject(faultOf(request.responseText, request.status)))
    request.onloadend = () => signal.removeEventListener('abort', stop)
    request.open('PUT', url)
    for (const [header, value] of Object.entries(headers)) request.setRequestHeader(header, value)
    request.send(file)
  })
}
