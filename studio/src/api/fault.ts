import type { Text } from '../text/en'
import type { FaultText, MissingGloss } from './schema'

/** Faults detected by the studio itself, named by the key of their message. */
export type OwnFault =
  'unreachable' | 'badAnswer' | 'streamRefused' | 'streamClosed' | 'fetcherStopped' | 'framesMissing' | 'noWebgl' | 'pictureLost' | 'noEaf' | 'noMotion'

/** A fault detected by the studio itself. It is shown in the user's language; `detail` is appended unchanged. */
export class StudioFault extends Error {
  constructor(
    readonly kind: OwnFault,
    readonly detail = '',
  ) {
    super(detail ? `${kind}: ${detail}` : kind)
  }
}

/** Position of a fault in a text that was sent: line and column from 1, counted in characters (code points). */
export interface FaultPlace {
  readonly line: number
  readonly column: number
}

/** Returns the error for a refusal. `status` is the HTTP status, or 0 if a stream refused. */
export function errorOf({ message, code, line, column, missing, suggestion }: FaultText, status: number): ApiError {
  return new ApiError(message, status, code, line && column ? { line, column } : undefined, suggestion, missing)
}

/** A refused call, with the server's message; for a query also the position. */
export class ApiError extends Error {
  constructor(
    message: string,
    readonly status: number,
    readonly code: string,
    readonly place?: FaultPlace,
    /** For an utterance: the correction that the server suggests. */
    readonly suggestion?: string,
    /** For an utterance: the glosses that do not exist. */
    readonly missing: readonly MissingGloss[] = [],
  ) {
    super(message)
  }
}

/** Returns the names listed in `did you mean A, B or C?`. */
export function suggested(message: string): string[] {
  const list = /did you mean (.+?)\?/.exec(message)?.[1]
  return list ? list.split(/, | or /).filter(Boolean) : []
}

/** Returns the message of a fault: the studio's own in the user's language, the server's as the server wrote it. */
export function messageOf(fault: unknown, text: Text): string {
  if (fault instanceof StudioFault) return fault.detail ? `${text[fault.kind]} (${fault.detail})` : text[fault.kind]
  return fault instanceof Error ? fault.message : String(fault)
}
