import { sessionOf, type Session, type Study } from './study'

/** Whether two are the same study, each with votes of its own. */
export const isSame = (a: Study, b: Study) =>
  a.at === b.at && a.database === b.database && a.settings.seed === b.settings.seed && a.items.length === b.items.length

/** What two tabs know of one study: no vote of either is lost. Of one trial that both answered the vote that `theirs` already keeps stays. */
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

/** The study with whose turn it was, where they are still in it. */
export function withTurn({ current: _, ...study }: Study, participant: string | undefined): Study {
  const there = { ...study, current: participant }
  return participant !== undefined && sessionOf(there) ? there : study
}
