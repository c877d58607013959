import { PageFault } from '../fault'
import { kFluencies, kFormat, kLabels, stepsOf, type Settings, type Study } from './study'

/** Reads a study saved as JSON. Throws if the text is something else, or if any field that the page needs is invalid. */
export function readStudy(text: string): Study {
  let study: unknown
  try {
    study = JSON.parse(text)
  } catch {
    throw new PageFault('noStudy')
  }
  if (!isStudy(study)) throw new PageFault('noStudy')
  return study
}

type Fields = Readonly<Record<string, unknown>>
const isObject = (value: unknown): value is Fields => typeof value === 'object' && value !== null && !Array.isArray(value)
const isNumber = (value: unknown): value is number => typeof value === 'number' && Number.isFinite(value)
const isText = (value: unknown): value is string => typeof value === 'string'
const isTruth = (value: unknown) => typeof value === 'boolean'
const isSide = (value: unknown) => value === 'left' || value === 'right'
const optional = (value: unknown, is: (value: unknown) => boolean) => value === undefined || is(value)
const listOf = (value: unknown, is: (value: unknown) => boolean): value is readonly Fields[] => Array.isArray(value) && value.every(is)
const areUnique = (names: readonly unknown[]) => new Set(names).size === names.length

function isStudy(study: unknown): study is Study {
  if (!isObject(study) || study.format !== kFormat || !isText(study.database) || !isText(study.version) || !isText(study.at) || !isSettings(study.settings))
    return false
  if (!listOf(study.items, isItem) || study.items.length === 0 || !optional(study.current, isText) || !optional(study.unblinded, isText)) return false
  const { items, sessions } = study
  return (
    listOf(sessions, (session) => isSession(session, items.length)) &&
    areUnique(sessions.map(({ participant }) => participant)) &&
    optional(study.recordings, (of) => isObject(of) && Object.values(of).every(isText)) &&
    optional(study.leftOut, (of) => listOf(of, isText))
  )
}
function isSettings(settings: unknown): boolean {
  if (!isObject(settings)) return false
  const { seed, mode, methods, trials, catches, around, order, recorded, natural, rating, comment, speed, turn, character, labels } = settings
  return (
    [seed, trials, catches, around].every(isNumber) &&
    (mode === 'pair' || mode === 'single') &&
    (order === 'own' || order === 'same') &&
    listOf(methods, isText) &&
    methods.length > 0 &&
    areUnique(methods) &&
    [recorded, natural, rating, comment, speed, turn].every(isTruth) &&
    (character === null || isText(character)) &&
    isObject(labels) &&
    kLabels.every((label) => {
      const one = labels[label]
      return isObject(one) && isText(one.en) && isText(one.fr)
    }) &&
    stepsOf(settings as unknown as Settings).length > 0
  )
}
const isItem = (item: unknown) =>
  isObject(item) && isText(item.recording) && isText(item.method) && isText(item.signs) && [item.from, item.to, item.begin, item.end].every(isNumber)
function isSession(session: unknown, items: number): boolean {
  if (!isObject(session) || !isText(session.participant) || !session.participant || !kFluencies.some((one) => one === session.fluency)) return false
  const { trials, answers, draft } = session
  return (
    listOf(trials, (trial) => isObject(trial) && Number.isInteger(trial.item) && Number(trial.item) >= 0 && Number(trial.item) < items && isSide(trial.side)) &&
    listOf(answers, isAnswer) &&
    answers.length <= trials.length &&
    optional(draft, (one) => isObject(one) && isGiven(one) && optional(one.comment, isText) && optional(one.plays, isNumber) && optional(one.ms, isNumber))
  )
}
const isAnswer = (answer: unknown) =>
  isObject(answer) &&
  isGiven(answer) &&
  isText(answer.comment) &&
  isNumber(answer.plays) &&
  isNumber(answer.ms) &&
  isText(answer.at) &&
  isTruth(answer.unblinded) &&
  optional(answer.version, isText)
const isGiven = ({ recorded, natural, rating }: Fields) =>
  optional(recorded, isSide) && optional(natural, isSide) && optional(rating, (one) => isNumber(one) && Number.isInteger(one) && one >= 1 && one <= 5)
