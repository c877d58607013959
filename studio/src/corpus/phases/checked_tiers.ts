import type { AnnotationDocument, Tier } from '../../annotation/document'
import type { TierChanges } from '../../api/corpus_calls'
import { kEmpty, kHands, put, type Hand, type Phase, type Review } from './review'

/// Phases checked by a person, in an EAF: a separate tier for each hand next to the signs, like the proposals written by `signweave segment`. They need not
/// fill signs, so their tier cannot be a subdividing child of the sign tier; an import assigns them to signs by their times and by the hand in the tier name.

const kTier: Readonly<Record<Hand, string>> = { right: 'Phase RH (checked)', left: 'Phase LH (checked)' }
const kType = 'checked phase'
/** A property of the document; its name must not begin with `signweave:`, which marks declarations that recordings show on every view. */
const kProperty = 'Phases (checked)'
/** A property that lists the begins of phases that were accepted all at once, by tier, so that a continued review still shows which they are. */
const kUnseen = 'Phases (accepted unseen)'
const pattern = (hand: Hand) => new RegExp(`^Phase ${hand === 'right' ? 'RH' : 'LH'} \\(checked(?: (\\d+))?\\)$`)

export const isChecked = (tier: string): Hand | undefined => kHands.find((hand) => pattern(hand).test(tier))

/**
 * Returns the checked phases of a document, from the newest tier of each hand; undefined if it has none. A property of the document records which were accepted
 * unseen.
 */
export function readChecked(document: AnnotationDocument): Review | undefined {
  let review = kEmpty,
    any = false
  const unseen = new Map(unseenIn(document))
  for (const hand of kHands) {
    const tier = document.tiers.filter(({ name }) => pattern(hand).test(name)).sort((a, b) => numberOf(b.name) - numberOf(a.name))[0]
    any ||= tier !== undefined
    const passed = unseen.get(tier?.name ?? '')
    let end = 0
    for (const one of tier?.annotations ?? []) {
      const begin = Math.max(end, Math.round(one.begin))
      end = Math.max(begin, Math.round(one.end))
      if (end > begin) review = put(review, { hand, kind: one.label, begin, end, state: 'accepted', ...(passed?.includes(begin) ? { unseen: true } : {}) })
    }
  }
  return any ? review : undefined
}
function unseenIn({ properties }: AnnotationDocument): readonly (readonly [tier: string, begins: readonly number[]])[] {
  return (properties?.[kUnseen] ?? '').split('; ').flatMap((one) => {
    const [, tier, begins] = /^(.+): ([\d ]+)$/.exec(one) ?? []
    return tier ? [[tier, begins.split(' ').map(Number)] as const] : []
  })
}
const numberOf = (name: string) => Number(/(\d+)\)$/.exec(name)?.[1] ?? 1)

/** What is written: the changes, and of each hand's tier its number of phases. */
export interface Written {
  readonly changes: TierChanges
  readonly tiers: readonly {
    readonly hand: Hand
    readonly name: string
    readonly count: number
    /** The number of phases that were accepted all at once. */ readonly unseen: number
  }[]
}

/**
 * Returns the changes that put the accepted phases into a document: the tiers written before are rewritten, under another name if other tiers depend on them or
 * if `kept` names their hand, because someone else wrote them meanwhile. `person` may be empty.
 */
export function checkedTiers(document: AnnotationDocument, review: Review, person: string, kept: readonly Hand[] = []): Written {
  const hands = kHands.map((hand) =>
    handTier(
      document.tiers,
      hand,
      review.phases[hand].filter(({ state }) => state === 'accepted'),
      kept.includes(hand),
    ),
  )
  const remove = hands.flatMap((one) => one.remove ?? []),
    made = hands.flatMap((one) => one.made ?? []),
    names = made.map(({ name }) => name)
  const properties: { name: string; value: string }[] = []
  if (names.length > 0 || document.properties?.[kProperty] !== undefined)
    properties.push({ name: kProperty, value: names.length > 0 ? `${names.join(', ')}: ${howChecked(made, person)}` : 'none' })
  // The entries of tiers that stay are preserved.
  const stays = (name: string) => document.tiers.some((one) => one.name === name) && !remove.includes(name)
  const unseen = [
    ...unseenIn(document).filter(([name]) => !names.includes(name) && stays(name)),
    ...made.filter(({ unseen }) => unseen.length > 0).map(({ name, unseen }) => [name, unseen] as const),
  ]
  const value = unseen.map(([name, begins]) => `${name}: ${begins.join(' ')}`).join('; ')
  if (value || document.properties?.[kUnseen] !== undefined) properties.push({ name: kUnseen, value: value || 'none' })
  const tiers = made.map(({ name, phases, participant, unseen }) => {
    const how = unseen.length === 0 ? 'checked' : unseen.length < phases.length ? 'partly checked' : 'accepted unseen'
    const annotations = phases.map(({ begin: begin_ms, end: end_ms, kind: label }) => ({ begin_ms, end_ms, label }))
    return { name, type: kType, annotator: `signweave, ${how} by ${person || 'a person'}`, participant, annotations }
  })
  return {
    changes: { remove, tiers, properties },
    tiers: made.map(({ hand, name, phases, unseen }) => ({ hand, name, count: phases.length, unseen: unseen.length })),
  }
}

interface HandTier {
  readonly hand: Hand
  readonly name: string
  readonly phases: readonly Phase[]
  readonly participant?: string
  /** Begins of phases that were accepted unseen. */ readonly unseen: readonly number[]
}

/** The tier of a hand, and the previous one in whose place it is written; no tier if there are no phases. */
function handTier(tiers: readonly Tier[], hand: Hand, phases: readonly Phase[], keepExisting: boolean): { readonly remove?: string; readonly made?: HandTier } {
  const ours = tiers.filter(({ name }) => pattern(hand).test(name)).sort((a, b) => numberOf(b.name) - numberOf(a.name))[0]
  let name = ours?.name ?? kTier[hand]
  const stays = ours && (keepExisting || tiers.some(({ parent }) => parent === name))
  if (stays) {
    let number = numberOf(name)
    while (tiers.some((one) => one.name === name)) name = kTier[hand].replace(')', ` ${++number})`)
  }
  const remove = ours && !stays ? ours.name : undefined
  if (phases.length === 0) return { remove }
  const unseen = phases.filter((one) => one.unseen).map(({ begin }) => begin)
  return { remove, made: { hand, name, phases, participant: ours?.participant ?? participantOf(tiers), unseen } }
}

function howChecked(made: readonly HandTier[], person: string): string {
  const who = person || 'a person',
    all = made.reduce((sum, { phases }) => sum + phases.length, 0),
    unseen = made.reduce((sum, one) => sum + one.unseen.length, 0)
  if (unseen === 0) return `proposed by signweave from motion alone, each phase checked by ${who}`
  return `proposed by signweave from motion alone, ${all - unseen} of ${all} phases checked by ${who}, ${unseen} accepted all at once without being looked at`
}

/** Returns the signer, if all original tiers name the same one. */
function participantOf(tiers: readonly Tier[]): string | undefined {
  const said = new Set(tiers.filter(({ name, parent }) => !parent && isChecked(name) === undefined).map(({ participant }) => participant ?? ''))
  return said.size === 1 ? [...said][0] || undefined : undefined
}

/** A short fingerprint of each hand's checked phases, which differs if they differ; empty if there are none. */
export type Stand = Readonly<Record<Hand, string>>
export function standOf({ tiers }: AnnotationDocument): Stand {
  const of = (hand: Hand) => {
    const ours = tiers.filter(({ name }) => pattern(hand).test(name))
    return ours.length > 0 ? `${ours.length} ${hashOf(JSON.stringify(ours.map(({ name, annotations }) => [name, annotations])))}` : ''
  }
  return { right: of('right'), left: of('left') }
}
function hashOf(text: string): string {
  let hash = 0x811c9dc5
  for (let i = 0; i < text.length; ++i) hash = Math.imul(hash ^ text.charCodeAt(i), 0x01000193)
  return (hash >>> 0).toString(36)
}
/** Returns the hands that have checked phases which differ from before. */
export const rewritten = (before: Stand, now: Stand): readonly Hand[] => kHands.filter((hand) => now[hand] !== '' && now[hand] !== before[hand])
