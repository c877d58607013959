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

/** A call that was refused, with the server's own line; of a query also where. */
export class ApiError extends Error {
  constructor(
    message: string,
    readonly status: number,
    readonly code: string,
    readonly place?: FaultPlace,
    /** Of an utterance: what was meant, as the server thinks. */
    readonly suggestion?: string,
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
