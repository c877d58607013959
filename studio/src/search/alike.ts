import type { AnnotationDocument } from '../annotation/document'
import { kindOf } from '../timeline/tier_kind'
import { pieceText, type Answer } from './answers'

/**
 * Returns the query for movements similar to a span of a recording (ms of annotation time). Signs are compared; if the span is an annotated phase, phases of
 * that kind.
 */
export function alikeQuery(recording: string, from: number, to: number, { tiers }: AnnotationDocument): string {
  const begin = Math.round(from),
    end = Math.round(to)
  const like = `like(${pieceText({ recording, begin, end })})`
  for (const { name, depth, annotations } of tiers) {
    const same = annotations.find((one) => Math.abs(one.begin - from) < 1 && Math.abs(one.end - to) < 1)
    const kind = same && depth > 0 ? kindOf(name, depth, same.label) : 'other'
    if (kind === 'preparation' || kind === 'stroke' || kind === 'retraction') return `phase = ${kind} & ${like}`
  }
  return like
}

/** Returns the query for movements similar to an answer to `asked`: phases of its kind if phases were searched. */
export function alikeOf(answer: Answer, asked: string): string {
  const kind = /\bphase\b/.test(asked) ? / (preparation|stroke|retraction)$/.exec(answer.name)?.[1] : undefined
  const like = `like(${pieceText(answer)})`
  return kind ? `phase = ${kind} & ${like}` : like
}
