import type { AnnotationDocument } from '../annotation/document'

/** Determines the colour of a box on the timeline. */
export type BoxKind = 'gloss' | 'preparation' | 'stroke' | 'retraction' | 'source' | 'junction' | 'other'

/** By the label of a phase, in the languages that corpora use; otherwise by the tier. */
export function kindOf(tierName: string, depth: number, label: string): BoxKind {
  const phase = label.toLowerCase()
  if (/^(prep|préparation|vorbereitung)/.test(phase)) return 'preparation'
  if (/^(stroke|nucleus|kern)/.test(phase)) return 'stroke'
  if (/^(retr|rétraction|rückzug|recovery)/.test(phase)) return 'retraction'
  if (tierName === 'Source') return 'source'
  if (tierName === 'Junction') return 'junction'
  return depth === 0 ? 'gloss' : 'other'
}

/** Returns the tier that arrow keys step through: the first one without a parent that has annotations. */
export function signTier(document: AnnotationDocument) {
  return document.tiers.find(({ depth, annotations }) => depth === 0 && annotations.length > 0)
}
