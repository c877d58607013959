import { PageFault } from '../fault'
import { kFluencies, kFormat, kLabels, type Study, type Trial } from './study'

const keyOf = (database: string) => `signweave.study.${database}`

/** The study of a database that this browser keeps; none where there is none. */
export function keptStudy(database: string): Study | undefined {
  try {
    const text = localStorage.getItem(keyOf(database))
    return text ? readStudy(text) : undefined
  } catch {
    return undefined
  }
}
/** Throws where the browser keeps nothing. */
export function keepStudy(database: string, study: Study | undefined): void {
  try {
    if (study) localStorage.setItem(keyOf(database), JSON.stringify(study))
    else localStorage.removeItem(keyOf(database))
  } catch {
    throw new PageFault('noStorage')
  }
}

/** Reads what was saved as JSON. Throws where it is something else. */
export function readStudy(text: string): Study {
  let study: Study
  try {
    study = JSON.parse(text) as Study
  } catch {
    throw new PageFault('noStudy')
  }
  if (!isStudy(study)) throw new PageFault('noStudy')
  return study
}

const isNumber = (value: unknown): value is number => typeof value === 'number' && Number.isFinite(value)
const isText = (value: unknown): value is string => typeof value === 'string'

function isStudy(study: Study | null): boolean {
  if (study?.format !== kFormat || !isText(study.database) || !isText(study.version) || !Array.isArray(study.items) || !Array.isArray(study.sessions)) return false
  const { settings, items, sessions } = study
  const right = typeof settings === 'object' && settings !== null && isNumber(settings.seed) && (settings.mode === 'pair' || settings.mode === 'single') &&
    (settings.character === null || isText(settings.character)) && kLabels.every((label) => isText(settings.labels?.[label]?.en) && isText(settings.labels[label].fr))
  return right && items.length > 0 && items.every((item) => isText(item?.recording) && isText(item.method) && [item.from, item.to, item.begin, item.end].every(isNumber)) &&
    sessions.every((session) => isText(session?.participant) && kFluencies.includes(session.fluency) && Array.isArray(session.trials) && Array.isArray(session.answers) &&
      session.answers.length <= session.trials.length && session.trials.every((trial: Partial<Trial> | null) => items[trial?.item ?? -1] !== undefined && (trial?.side === 'left' || trial?.side === 'right')))
}
