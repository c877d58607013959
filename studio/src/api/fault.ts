import type { Text } from '../text/en'

/** What can go wrong on this side of the server, by the key of its words. */
export type OwnFault = 'unreachable' | 'badAnswer' | 'streamRefused' | 'streamClosed' | 'fetcherStopped' | 'framesMissing' | 'noWebgl' | 'pictureLost' | 'noEaf'

/** A fault that the studio itself saw. It is shown in the user's language; `detail` stands behind it as it is. */
export class StudioFault extends Error {
  constructor(
    readonly kind: OwnFault,
    readonly detail = '',
  ) {
    super(detail ? `${kind}: ${detail}` : kind)
  }
}

/** Where a fault is in a text that was sent: line and column from 1, counted in characters (code points). */
export interface FaultPlace {
  readonly line: number
  readonly column: number
}

/** A gloss of an utterance that no sign has. */
export interface MissingGloss {
  readonly gloss: string
  /** Those that were probably meant, the likeliest first. */ readonly matches: readonly string[]
  /** Whether the matches differ in spelling only: case, accents, width. */ readonly folds: boolean
}

/** What a refusal says, as the server sends it over HTTP and over a stream. */
export interface Refusal {
  readonly message: string
  readonly code: string
  readonly line?: number
  readonly column?: number
  readonly missing?: readonly MissingGloss[]
  readonly suggestion?: string
}

/** The error of a refusal. `status` is that of HTTP, or 0 where a stream refused. */
export function errorOf({ message, code, line, column, missing, suggestion }: Refusal, status: number): ApiError {
  return new ApiError(message, status, code, line && column ? { line, column } : undefined, suggestion, missing)
}

/** A call that was refused, with the server's own line; of a query also where. */
export class ApiError extends Error {
  constructor(
    message: string,
    readonly status: number,
    readonly code: string,
    readonly place?: FaultPlace,
    /** Of an utterance: what was meant, as the server thinks. */
    readonly suggestion?: string,
    /** Of an utterance: the glosses that are not there. */
    readonly missing: readonly MissingGloss[] = [],
  ) {
    super(message)
  }
}

/** What `did you mean A, B or C?` names. */
export function suggested(message: string): string[] {
  const list = /did you mean (.+?)\?/.exec(message)?.[1]
  return list ? list.split(/, | or /).filter(Boolean) : []
}

/** A fault in plain words: the studio's own in the user's language, the server's as the server wrote it. */
export function wordsOf(fault: unknown, text: Text): string {
  if (fault instanceof StudioFault) return fault.detail ? `${text[fault.kind]} (${fault.detail})` : text[fault.kind]
  return fault instanceof Error ? fault.message : String(fault)
}
