import type { AnnotationDocument } from '../annotation/document'

/** How a box of the timeline is coloured. */
export type BoxKind = 'gloss' | 'preparation' | 'stroke' | 'retraction' | 'source' | 'junction' | 'other'

/** By the label of a phase, in the languages that corpora use; else by the tier. */
export function kindOf(tierName: string, depth: number, label: string): BoxKind {
  const phase = label.toLowerCase()
  if (/^(prep|préparation|vorbereitung)/.test(phase)) return 'preparation'
  if (/^(stroke|nucleus|kern)/.test(phase)) return 'stroke'
  if (/^(retr|rétraction|rückzug|recovery)/.test(phase)) return 'retraction'
  if (tierName === 'Source') return 'source'
  if (tierName === 'Junction') return 'junction'
  return depth === 0 ? 'gloss' : 'other'
}

/** The tier that arrow keys walk along: the first one without a parent that has annotations. */
export function signTier(document: AnnotationDocument) {
  return document.tiers.find(({ depth, annotations }) => depth === 0 && annotations.length > 0)
}
