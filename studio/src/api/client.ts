import type { Rig } from '../motion/skeleton'
import type { Declarations } from '../motion/source'
import { ApiError, StudioFault } from './fault'

export interface DatabaseRow { readonly name: string; readonly recordings: number; readonly writable: boolean }
export interface RecordingRow {
  readonly name: string; readonly signer: string; readonly frames: number; readonly frames_per_second: number; readonly joints: number
  readonly tracks: readonly string[]; readonly defects: number
}
/** A part of the body: the joint's name and index, and for a tip its offset in metres. */
export interface PartRow { readonly joint: string; readonly index: number; readonly offset?: readonly [number, number, number] }
export interface RecordingInfo {
  readonly recording: string; readonly signer: string; readonly frames: number; readonly frames_per_second: number
  readonly seconds: number; readonly joints: number; readonly scalar_tracks: number; readonly clock_origin_ms: number
  readonly annotation_file: string; readonly phases: number; readonly shoulder_width_m?: number
  readonly rig?: { readonly convention: string; readonly parts: Readonly<Record<string, PartRow>> }
  readonly defects: readonly { kind?: string; text?: string }[]
}
export interface Spread { readonly count: number; readonly mean?: number; readonly sd?: number;
  readonly quantiles?: Readonly<Record<string, number>> }
export interface Transitions {
  readonly inferred?: boolean
  readonly whole: { readonly duration_ms: Spread }
  /** Not where transitions are inferred from the gaps between signs, for no phases are annotated. */
  readonly retraction?: { readonly duration_ms: Spread }
  readonly preparation?: { readonly duration_ms: Spread }
}
export interface Statistics {
  readonly all: Transitions
  readonly recordings: readonly (Transitions & { readonly recording: string })[]
}
/** One sign of a report: where it is in the new motion and where it was recorded; ms. */
export interface ReportSign {
  readonly gloss: string; readonly begin_ms: number; readonly end_ms: number; readonly recording: string
  readonly recorded: { readonly begin_ms: number; readonly end_ms: number }
}
/** Which joint of a recording plays which part; empty where the rig map could not tell. */
export function rigOf(info: RecordingInfo): Rig {
  const parts = Object.entries(info.rig?.parts ?? {})
  return Object.fromEntries(parts.map(([part, { index, offset }]) => [part, { joint: index, offset }]))
}

/** The calls of docs/http.md that the studio makes. */
export class Api {
  /** What answers so far have said of their recordings. */
  onDeclarations?: (declarations: Declarations) => void

  /** `base` is the address of `/api`, relative to the page; `token` goes with every call where the server asks for one. */
  constructor(private readonly base = 'api', private readonly token = '') {}

  headers(more: Record<string, string> = {}): Record<string, string> {
    return this.token ? { ...more, Authorization: `Bearer ${this.token}` } : more
  }

  async databases(): Promise<readonly DatabaseRow[]> {
    return (await this.json<{ databases: DatabaseRow[] }>('databases')).databases
  }
  async recordings(database: string): Promise<readonly RecordingRow[]> {
    return (await this.json<{ recordings: RecordingRow[] }>(this.of(database))).recordings
  }
  recording(database: string, recording: string): Promise<RecordingInfo> {
    return this.json(this.of(database, 'recordings', recording))
  }
  statistics(database: string, recording?: string): Promise<Statistics> {
    return this.json(this.of(database, 'stats') + (recording ? `?recording=${encodeURIComponent(recording)}` : ''))
  }
  async statisticsPlot(database: string, recording?: string): Promise<Blob> {
    const query = recording ? `&recording=${encodeURIComponent(recording)}` : ''
    return (await this.call(`${this.of(database, 'stats')}?format=svg${query}`)).blob()
  }
  async annotation(database: string, recording: string): Promise<string> {
    return (await this.call(this.of(database, 'recordings', recording, 'annotation'))).text()
  }
  /** What was made, as ELAN shows it: `call` is `sign` or `edit`, `body` its parameters. */
  async madeAnnotation(database: string, call: 'sign' | 'edit', body: object): Promise<string> {
    return (await this.post(this.of(database, call), { ...body, format: 'eaf' })).text()
  }
  /** A few frames of a recording as a model with the person that the server draws. */
  async drawnPerson(database: string, recording: string, fromMs: number, toMs: number): Promise<ArrayBuffer> {
    const path = this.of(database, 'recordings', recording, 'motion')
    return (await this.call(`${path}?format=glb&from=${fromMs}&to=${toMs}`)).arrayBuffer()
  }
  motionUrl(database: string, recording: string, fromMs: number, toMs: number): string {
    return `${this.base}/${this.of(database, 'recordings', recording, 'motion')}?format=json&from=${fromMs}&to=${toMs}`
  }
  madeUrl(database: string, call: 'sign' | 'edit'): string {
    return `${this.base}/${this.of(database, call)}`
  }
  streamUrl(database: string): string {
    const url = new URL(`${this.base}/stream?database=${encodeURIComponent(database)}`, document.baseURI)
    if (this.token) url.searchParams.set('token', this.token)
    url.protocol = url.protocol.replace('http', 'ws')
    return url.href
  }

  private of(database: string, ...rest: string[]): string {
    return ['databases', database, ...rest].map(encodeURIComponent).join('/')
  }
  private async json<T>(path: string): Promise<T> {
    return (await this.call(path)).json() as Promise<T>
  }
  private post(path: string, body: object): Promise<Response> {
    return this.call(path, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) })
  }
  private async call(path: string, init: { method?: string; headers?: Record<string, string>; body?: string } = {}): Promise<Response> {
    let response: Response
    try {
      response = await fetch(`${this.base}/${path}`, { ...init, headers: this.headers(init.headers) })
    } catch {
      throw new StudioFault('unreachable')
    }
    if (!response.ok) throw faultOf(await response.text().catch(() => ''), response.status)
    const declared = response.headers.get('Signweave-Declarations')
    if (declared) this.onDeclarations?.(declarationsOf(declared))
    return response
  }
}

/** What an answer that is no success says: the server's own line, or that there was none. */
export function faultOf(body: string, status: number): ApiError | StudioFault {
  try {
    const { message, code } = (JSON.parse(body) as { error: { message: string; code: string } }).error
    return new ApiError(message, status, code)
  } catch {
    return new StudioFault('badAnswer', String(status))
  }
}

/** The header's object; a header that is none is shown as it came, for what sources declare must be seen. */
function declarationsOf(header: string): Declarations {
  try {
    return JSON.parse(header) as Declarations
  } catch {
    return { 'Signweave-Declarations': header }
  }
}
