import { readFrames, type FrameTaker } from '../motion/frames_body'
import { decoded } from '../annotation/decoded'
import type { Declarations } from '../motion/declarations'
import type {
  CharacterRow,
  DatabaseRow,
  ExplainedReport,
  JobBegun,
  JobState,
  MediaRow,
  NoticeRow,
  RecordingInfo,
  RecordingRow,
  SignAnswer,
  Statistics,
  TierLabels,
  TransitionRow,
  UtteranceAnswer,
  Vocabulary,
} from './answers'
import { ApiError, errorOf, StudioFault, type Refusal } from './fault'

/** How long a server may be silent while a job is under way there, in ms. */
const kPatience = 30_000

type Query = Readonly<Record<string, string | number | undefined>>

/** Which piece of a recording, in ms of annotation time, and what is regenerated in it. */
export interface PieceWishes {
  readonly from: number
  readonly to: number
  readonly character?: string
  /** `FROM..TO` in ms: captured frames that are cut out and made again by the method `transition`. */
  readonly regenerate?: string
  readonly transition?: string
}

/** Where the server's description of itself tells how transitions are made. */
interface SignDescription {
  readonly post: {
    readonly requestBody: {
      readonly content: {
        readonly 'application/json': {
          readonly schema: {
            readonly properties: {
              readonly transition: { readonly description: string; readonly enum: readonly string[] }
            }
          }
        }
      }
    }
  }
}
/** A call that was answered: `where` is its path and query, `body` its JSON where it had one. */
export interface Answered {
  readonly method: string
  readonly where: string
  readonly body: string
}
/** What is asked, and how many answers are wanted at most. */
export interface QueryWishes {
  readonly text: string
  readonly limit?: number
}

/** The calls of docs/http.md that the studio makes. */
export class Api {
  /** Told what an answer says of its recordings, and of which database it is; none where the address of the call does not tell. */
  onDeclarations?: (declarations: Declarations, database: string | undefined) => void
  /** Told of every call that was answered: for who follows what somebody does. */
  onAnswered?: (call: Answered) => void

  /** Told where a call was refused for want of the right token. */
  onUnauthorized?: () => void

  /** `base` is the address of `/api`, relative to the page; `token` goes with every call where the server asks for one. */
  constructor(
    private readonly base = 'api',
    public token = '',
  ) {}

  async databases(): Promise<readonly DatabaseRow[]> {
    const { databases } = await this.json<{ databases: DatabaseRow[] }>('databases')
    for (const { name, declarations } of databases) if (Object.keys(declarations).length > 0) this.onDeclarations?.(declarations, name)
    return databases
  }
  /** The signers that this server can put motion on; none where it was given none. */
  async characters(): Promise<readonly CharacterRow[]> {
    return (await this.json<{ characters: CharacterRow[] }>('characters')).characters
  }
  /** A character's GLB. */
  async character(name: string): Promise<ArrayBuffer> {
    return (await this.call(path('characters', name))).arrayBuffer()
  }
  async recordings(database: string): Promise<readonly RecordingRow[]> {
    return (await this.json<{ recordings: RecordingRow[] }>(path('databases', database))).recordings
  }
  recording(database: string, recording: string): Promise<RecordingInfo> {
    return this.json(path('databases', database, 'recordings', recording))
  }
  async media(database: string, recording: string): Promise<readonly MediaRow[]> {
    return (await this.json<{ media: MediaRow[] }>(path('databases', database, 'recordings', recording, 'media'))).media
  }
  statistics(database: string, recording?: string): Promise<Statistics> {
    return this.json(path('databases', database, 'stats') + query({ recording }))
  }
  async statisticsPlot(database: string, recording?: string): Promise<Blob> {
    return (await this.call(path('databases', database, 'stats') + query({ format: 'svg', recording }))).blob()
  }
  async annotation(database: string, recording: string): Promise<string> {
    return decoded(await (await this.call(path('databases', database, 'recordings', recording, 'annotation'))).arrayBuffer())
  }
  /** What was made, as ELAN shows it: `call` is `sign` or `edit`, `body` its parameters. */
  async madeAnnotation(database: string, call: 'sign' | 'edit', body: object): Promise<string> {
    return (await this.post(path('databases', database, call), { ...body, format: 'eaf' })).text()
  }
  /** Frames of a recording, in ms of annotation time, in the joints of a character where one is named; ends when all have come. */
  async motion(
    database: string,
    recording: string,
    from: number,
    to: number,
    character: string | undefined,
    taker: FrameTaker,
    signal?: AbortSignal,
  ): Promise<void> {
    const where = path('databases', database, 'recordings', recording, 'motion')
    const response = await this.call(where + query({ format: 'frames', from, to, character }), { signal })
    await readFrames(response.body!, taker)
  }
  /** Frames of motion that a call makes, as `motion` gives them. */
  async made(database: string, call: 'sign' | 'edit', body: object, character: string | undefined, taker: FrameTaker, signal?: AbortSignal): Promise<void> {
    const response = await this.post(path('databases', database, call), { ...body, character, format: 'frames' }, signal)
    await readFrames(response.body!, taker)
  }
  /** A piece of a recording, as `motion` gives it. */
  async piece(database: string, recording: string, wishes: PieceWishes, taker: FrameTaker, signal?: AbortSignal): Promise<void> {
    const response = await this.call(path('databases', database, 'recordings', recording, 'motion') + query({ format: 'frames', ...wishes }), { signal })
    await readFrames(response.body!, taker)
  }
  /** What `sign` would make, with what there was to choose from. */
  async explained(database: string, body: object, signal?: AbortSignal): Promise<ExplainedReport> {
    return (await this.post(path('databases', database, 'sign'), { ...body, explain: true }, signal)).json() as Promise<ExplainedReport>
  }
  /** The places and the faults of an utterance's text. */
  async utterance(text: string, signal?: AbortSignal): Promise<UtteranceAnswer> {
    return (await this.post('utterance', { text }, signal)).json() as Promise<UtteranceAnswer>
  }
  /** What `sign` makes, as a file of a format. */
  async madeFile(database: string, body: object, signal?: AbortSignal): Promise<Blob> {
    return (await this.post(path('databases', database, 'sign'), body, signal)).blob()
  }
  /** The signs of a recording in the order of time, tier after tier. */
  signs(database: string, recording: string): Promise<readonly SignAnswer[]> {
    const name = recording.replace(/[\\"]/g, '\\$&')
    return this.json(path('databases', database, 'query') + query({ text: `gloss =~ /.*/ & recording = "${name}"` }))
  }
  /** How transitions can be made, the one that is taken where nothing is said first. */
  async transitions(): Promise<readonly TransitionRow[]> {
    const { paths } = await this.json<{ paths: Record<string, SignDescription> }>('openapi.json')
    const { description, enum: names } = paths['/databases/{database}/sign'].post.requestBody.content['application/json'].schema.properties.transition
    return names.map((name) => ({
      name,
      description:
        description
          .split('\n')
          .map((line) => line.trim())
          .find((line) => line.startsWith(`${name}: `))
          ?.slice(name.length + 2) ?? '',
    }))
  }
  /** What a query finds, as CSV while it comes: it may be a hundred thousand rows. */
  async find(
    database: string,
    wishes: QueryWishes,
    signal?: AbortSignal,
  ): Promise<{ readonly csv: ReadableStream<Uint8Array>; readonly notices: readonly NoticeRow[] }> {
    const response = await this.post(path('databases', database, 'query'), { ...wishes, format: 'csv' }, signal)
    return { csv: response.body!, notices: noticesOf(response.headers.get('Signweave-Notices')) }
  }
  /** The same as the server writes it in JSON, with the parts of each answer. */
  async found(database: string, wishes: QueryWishes, signal?: AbortSignal): Promise<readonly object[]> {
    return (await this.post(path('databases', database, 'query'), wishes, signal)).json() as Promise<readonly object[]>
  }
  /** A piece of a recording as a file of motion. */
  async pieceFile(database: string, recording: string, wishes: PieceWishes & { readonly format: string }, signal?: AbortSignal): Promise<Blob> {
    return (await this.call(path('databases', database, 'recordings', recording, 'motion') + query({ ...wishes }), { signal })).blob()
  }
  /** What can be asked for and signed: for completion. */
  vocabulary(database: string): Promise<Vocabulary> {
    return this.json(path('databases', database, 'vocabulary'))
  }
  labels(database: string, tier: string): Promise<TierLabels> {
    return this.json(path('databases', database, 'labels') + query({ tier }))
  }
  /** How far a job is; of its list of recordings only those at `from` and after it. */
  job<Result>(id: string, from = 0): Promise<JobState<Result>> {
    return this.json(path('jobs', id) + (from > 0 ? query({ from }) : ''))
  }
  /**
   * Waits until a job is over, and gives its result; throws what it failed with. `listener` hears how far it is. A server that does not answer is waited
   * for so many ms of `patience`: the job goes on there.
   */
  async result<Result>({ job }: JobBegun, listener: (state: JobState<Result>) => void = () => {}, signal?: AbortSignal, patience = kPatience): Promise<Result> {
    const recordings: unknown[] = []
    for (let wait = 100, away = 0; ; wait = Math.min(1000, wait * 1.3)) {
      let state: JobState<Result> | undefined
      try {
        state = await this.job<Result>(job, recordings.length)
      } catch (fault) {
        // What is listener of it, such as that there is no such job, is no silence.
        if (fault instanceof ApiError || away >= patience) throw fault
      }
      away = state ? 0 : away + wait
      // A long list comes in parts, each once.
      const more = (state?.result as { recordings?: unknown } | undefined)?.recordings
      if (state && Array.isArray(more)) {
        for (const one of more) recordings.push(one)
        state = { ...state, result: { ...state.result!, recordings } }
      }
      if (state) listener(state)
      if (state?.state === 'done') return state.result!
      if (state?.state === 'failed' || state?.state === 'cancelled')
        throw new ApiError(state.error?.message ?? state.state, 500, state.error?.code ?? state.state)
      await new Promise((resolve) => setTimeout(resolve, wait))
      if (signal?.aborted) throw signal.reason
    }
  }
  /** Stops a job as soon as may be. */
  async cancel(job: string): Promise<void> {
    await this.call(path('jobs', job), { method: 'DELETE' })
  }
  /** Begins to make captured movements again by each of some methods, and to compare. */
  async evaluate(database: string, wishes: { readonly method: readonly string[]; readonly seed: number }): Promise<JobBegun> {
    return (await this.post(path('databases', database, 'evaluate'), wishes)).json() as Promise<JobBegun>
  }
  /** Of the server's program. */
  async version(): Promise<string> {
    return (await this.json<{ info: { version: string } }>('openapi.json')).info.version
  }
  streamUrl(database: string): string {
    const url = this.address(`stream${query({ database, token: this.token || undefined })}`)
    url.protocol = url.protocol.replace('http', 'ws')
    return url.href
  }
  /** Where a film of `media` is for the page itself, which sends no header with it. */
  mediaUrl(url: string): string {
    const at = new URL(url, this.address(''))
    if (this.token) at.searchParams.set('token', this.token)
    return at.href
  }

  /** What goes with a call that `fetch` does not make: where it goes to, and what it must say. */
  request(where: string): { readonly url: string; readonly headers: Readonly<Record<string, string>> } {
    return { url: this.address(where).href, headers: this.token ? { Authorization: `Bearer ${this.token}` } : {} }
  }
  private address(where: string): URL {
    return new URL(`${this.base}/${where}`, document.baseURI)
  }
  async json<T>(where: string, init?: RequestInit & { headers?: Record<string, string> }): Promise<T> {
    return (await this.call(where, init)).json() as Promise<T>
  }
  post(where: string, body: object, signal?: AbortSignal): Promise<Response> {
    return this.call(where, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body), signal })
  }
  async call(where: string, init: RequestInit & { headers?: Record<string, string> } = {}): Promise<Response> {
    const headers = this.token ? { ...init.headers, Authorization: `Bearer ${this.token}` } : init.headers
    let response: Response
    try {
      response = await fetch(`${this.base}/${where}`, { ...init, headers })
    } catch (fault) {
      if (init.signal?.aborted) throw fault
      throw new StudioFault('unreachable')
    }
    if (response.status === 401) this.onUnauthorized?.()
    if (!response.ok) throw faultOf(await response.text().catch(() => ''), response.status)
    const declared = response.headers.get('Signweave-Declarations')
    // The list of databases says in each row what is of that one.
    if (declared && where !== 'databases') this.onDeclarations?.(declarationsOf(declared), databaseOf(where))
    this.onAnswered?.({ method: init.method ?? 'GET', where, body: typeof init.body === 'string' ? init.body : '' })
    return response
  }
}

export function path(...names: string[]): string {
  return names.map(encodeURIComponent).join('/')
}

export function query(values: Query): string {
  const given = Object.entries(values).filter(([, value]) => value !== undefined)
  return given.length ? `?${given.map(([name, value]) => `${name}=${encodeURIComponent(value!)}`).join('&')}` : ''
}

/** The database that a call is about. */
function databaseOf(where: string): string | undefined {
  const [, name] = /^databases\/([^/?]+)/.exec(where) ?? []
  return name && decodeURIComponent(name)
}

/** What an answer that is no success says: the server's own line, or that there was none. */
export function faultOf(body: string, status: number): ApiError | StudioFault {
  try {
    return errorOf((JSON.parse(body) as { error: Refusal }).error, status)
  } catch {
    return new StudioFault('badAnswer', String(status))
  }
}

/** The header's list; one that is none is listener as it came. */
function noticesOf(header: string | null): readonly NoticeRow[] {
  if (!header) return []
  try {
    return JSON.parse(header) as NoticeRow[]
  } catch {
    return [{ where: '', text: header }]
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
