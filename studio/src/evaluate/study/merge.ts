import { sessionOf, type Session, type Study } from './study'

/** Whether two states belong to the same study, each with its own votes. */
export const isSame = (a: Study, b: Study) =>
  a.at === b.at && a.database === b.database && a.settings.seed === b.settings.seed && a.items.length === b.items.length

/** Merges two tabs' states of one study without losing a vote of either. If both answered one trial, the vote already stored in `theirs` wins. */
export function merged(mine: Study, theirs: Study): Study {
  const own = new Map(mine.sessions.map((session) => [session.participant, session]))
  const known = new Set(theirs.sessions.map(({ participant }) => participant))
  const sessions = [
    ...theirs.sessions.map((session) => fuller(own.get(session.participant) ?? session, session)),
    ...mine.sessions.filter(({ participant }) => !known.has(participant)),
  ]
  const [unblinded] = [mine.unblinded, theirs.unblinded].filter((at) => at !== undefined).toSorted()
  return { ...mine, sessions, ...(unblinded === undefined ? {} : { unblinded }) }
}
function fuller(mine: Session, theirs: Session): Session {
  if (mine.answers.length !== theirs.answers.length) return mine.answers.length > theirs.answers.length ? mine : theirs
  return mine.answers.at(-1)?.at === theirs.answers.at(-1)?.at ? mine : theirs
}

export const votesIn = (study: Study) => study.sessions.reduce((sum, { answers }) => sum + answers.length, 0)

/** Sets the current participant, if the study still contains them. */
export function withTurn({ current: _, ...study }: Study, participant: string | undefined): Study {
  const there = { ...study, current: participant }
  return participant !== undefined && sessionOf(there) ? there : study
}
