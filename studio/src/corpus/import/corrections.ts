import type { TierRow } from '../../api/schema'
import type { HandName } from '../../api/types'
import type { Remedy } from '../../api/schema'

/** A parameter that determines how an import reads files, named as in `signweave import`. */
export interface Setting {
  readonly name: SettingName
  /** The values to choose from; if missing, the value is typed. */
  readonly choices?: readonly string[]
  readonly flag?: boolean
  /** Extensions of the motion files that it applies to; if missing, it applies to all recordings. */
  readonly of?: readonly string[]
  /** It is set for all recordings together; for a single one, its tiers determine it. */
  readonly ofAll?: boolean
  /** What may be typed. */
  readonly pattern?: RegExp
}
export type SettingName =
  | 'up'
  | 'unit'
  | 'mirror'
  | 'root_unit'
  | 'root_order'
  | 'source_rate'
  | 'take'
  | 'offset_ms'
  | 'face_offset_ms'
  | 'face_timecode'
  | 'sync'
  | 'replace_motion'
  | 'no_sign_tier'
  | 'no_phase_tier'

const kKeyed = ['.fbx', '.glb', '.gltf'],
  kNumber = /^[-+]?\d+([.,]\d+)?$/
const kUnit = /^(cm|m|mm|in|\d*[.,]?\d+(e-?\d+)?)$/
export const kSettings: readonly Setting[] = [
  { name: 'up', choices: ['y', 'z'], of: ['.bvh', '.amc'] },
  { name: 'unit', pattern: kUnit },
  { name: 'mirror', flag: true, of: ['.bvh'] },
  { name: 'root_unit', pattern: kUnit, of: ['.bvh'] },
  { name: 'root_order', choices: ['declared', 'rotation_first'], of: ['.bvh'] },
  { name: 'source_rate', pattern: /^\d+([.,]\d+)?(\/\d+)?$/, of: ['.amc', ...kKeyed] },
  { name: 'take', of: kKeyed },
  { name: 'offset_ms', pattern: kNumber },
  { name: 'sync', pattern: /^\d+([.,]\d+)?@[-+]?\d+([.,]\d+)?\s+\d+([.,]\d+)?@[-+]?\d+([.,]\d+)?$/ },
  { name: 'face_offset_ms', pattern: kNumber },
  { name: 'face_timecode', pattern: /^\d\d:\d\d:\d\d[:;]\d\d$/ },
  { name: 'replace_motion', flag: true },
  { name: 'no_sign_tier', flag: true, ofAll: true },
  { name: 'no_phase_tier', flag: true, ofAll: true },
]

/** The role assigned to a tier. */
export interface TierRole {
  readonly tier: string
  readonly role: TierRow['role']
  readonly hand: HandName
}
/** The corrections a user made for one recording, or for all. A missing setting is taken from those for all, then from the file. */
export interface Corrections {
  readonly settings: Readonly<Partial<Record<SettingName, string>>>
  readonly signer?: string
  /** All tiers of the annotation; missing if the server's guess applies. */
  readonly tiers?: readonly TierRole[]
  /** [part] its joint; empty if the body has no such part. */
  readonly rig?: Readonly<Record<string, string>>
}
export const kNone: Corrections = { settings: {} }

/** The value of a setting: that of the recording if not empty, else that for all. */
export function settingOf(all: Corrections, one: Corrections | undefined, name: SettingName): string {
  return one?.settings[name] || all.settings[name] || ''
}

export const fits = ({ of }: Setting, motion: string | null) => !of || (motion !== null && of.some((extension) => motion.toLowerCase().endsWith(extension)))

/** Whether a setting can be sent as it was typed. */
export const isRight = ({ pattern }: Setting, value: string) => value === '' || !pattern || pattern.test(value.trim())

/** The import parameters that follow from the corrections of one recording, except `pairs`, `rig` and `recordings`. Invalid ones are left out. */
export function parametersOf(all: Corrections, one: Corrections | undefined, motion: string | null): Readonly<Record<string, unknown>> {
  const body: Record<string, unknown> = {}
  for (const setting of kSettings) {
    const value = settingOf(all, one, setting.name).trim()
    if (!value || setting.ofAll || !fits(setting, motion) || !isRight(setting, value)) continue
    const plain = setting.pattern ? value.replaceAll(',', '.') : value
    if (setting.flag) body[setting.name] = true
    else if (setting.name === 'sync') body.sync = plain.split(/\s+/)
    else body[setting.name] = /_ms$/.test(setting.name) ? Number(plain) : plain
  }
  // If the user did not assign roles to its tiers, they are guessed, unless no recording has any.
  const tiers = one?.tiers
  const signs = tiers?.filter(({ role }) => role === 'signs') ?? [],
    phases = tiers?.filter(({ role }) => role === 'phases') ?? []
  if (signs.length > 0) body.sign_tier = signs.map(signTier)
  else if (tiers || all.settings.no_sign_tier) body.no_sign_tier = true
  if (phases.length > 0) body.phase_tier = phases.map(({ tier }) => tier)
  else if (tiers || all.settings.no_phase_tier) body.no_phase_tier = true
  return body
}

const kReading: ReadonlySet<string> = new Set<SettingName>(['up', 'unit', 'mirror', 'root_unit', 'root_order', 'source_rate', 'take'])
/** The import parameters that determine how a motion file is read. */
export const readingOf = (parameters: Readonly<Record<string, unknown>>): Readonly<Record<string, unknown>> =>
  Object.fromEntries(Object.entries(parameters).filter(([name]) => kReading.has(name)))

/** A tier in the syntax of `--sign-tier`: a name that contains a colon is written with all three parts. */
function signTier({ tier, hand }: TierRole): string {
  if (tier.includes(':')) return `${tier}:${hand}:`
  return hand === 'both' ? tier : `${tier}:${hand}`
}

/** A mapping file's text (docs/rig.md). */
export function rigText(rig: Readonly<Record<string, string>>): string {
  return Object.entries(rig)
    .map(([part, joint]) => `${part} = ${joint}\n`)
    .join('')
}

/** Reads a mapping file; other lines are ignored. */
export function readRig(text: string): Readonly<Record<string, string>> {
  const rig: Record<string, string> = {}
  for (const line of text.split(/\r?\n/)) {
    const [whole, part, joint] = /^\s*([a-z_]+)\s*=\s*(.*?)\s*$/.exec(line.replace(/(^|\s)#.*$/, '')) ?? []
    if (whole !== undefined) rig[part] = joint
  }
  return rig
}

/** The settings that fix what a notice or a fault reports, by the values of its remedies; undefined if it has none that can be set here. */
export function fixOf(remedies: readonly Remedy[] | undefined): Readonly<Partial<Record<SettingName, string>>> | undefined {
  const found = (remedies ?? []).flatMap(({ parameter, value }) => (value ? [[parameter, value === 'true' ? 'yes' : value] as const] : []))
  if (found.length === 0 || !found.every(([name]) => kSettings.some((setting) => setting.name === name))) return undefined
  return Object.fromEntries(found)
}

/** The settings that a user has to choose to fix what a notice or a fault reports. */
export function choicesOf(remedies: readonly Remedy[] | undefined): readonly SettingName[] {
  return kSettings.filter(({ name }) => remedies?.some(({ parameter, value }) => parameter === name && !value)).map(({ name }) => name)
}

/** The recordings of one call, which have the same parameters. */
export interface Group {
  readonly keys: readonly string[]
  readonly body: Readonly<Record<string, unknown>>
  /** The mapping file's text; empty if there is none. */ readonly rig: string
}

/** Puts recordings with the same parameters into one call. */
export function grouped(
  recordings: readonly { readonly key: string; readonly motion: string | null; readonly one?: Corrections }[],
  all: Corrections,
): readonly Group[] {
  const groups = new Map<string, { keys: string[]; body: Readonly<Record<string, unknown>>; rig: string }>()
  for (const { key, motion, one } of recordings) {
    const body = parametersOf(all, one, motion),
      rig = motion ? rigText({ ...all.rig, ...one?.rig }) : ''
    const same = JSON.stringify([body, rig])
    const group = groups.get(same)
    if (group) group.keys.push(key)
    else groups.set(same, { keys: [key], body, rig })
  }
  return [...groups.values()]
}
