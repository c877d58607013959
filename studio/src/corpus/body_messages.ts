/// Names of body parts and of motion defects, as the server's reports identify them.

type Language = 'en' | 'fr'
interface Messages {
  readonly [name: string]: string
}

const kParts: Readonly<Record<Language, Messages>> = {
  en: {
    pelvis: 'pelvis',
    spine: 'spine',
    chest: 'chest',
    neck: 'neck',
    head: 'head',
    head_top: 'crown',
    jaw: 'jaw',
    eye: 'eye',
    clavicle: 'collar bone',
    upper_arm: 'shoulder',
    forearm: 'elbow',
    hand: 'wrist',
    thigh: 'hip',
    shin: 'knee',
    foot: 'ankle',
    toes: 'toes',
    thumb: 'thumb',
    index: 'index',
    middle: 'middle finger',
    ring: 'ring finger',
    little: 'little finger',
    metacarpal: 'palm',
    proximal: '1st joint',
    intermediate: '2nd joint',
    distal: '3rd joint',
    tip: 'tip',
    left: 'left',
    right: 'right',
  },
  fr: {
    pelvis: 'bassin',
    spine: 'colonne',
    chest: 'poitrine',
    neck: 'cou',
    head: 'tête',
    head_top: 'sommet de la tête',
    jaw: 'mâchoire',
    eye: 'œil',
    clavicle: 'clavicule',
    upper_arm: 'épaule',
    forearm: 'coude',
    hand: 'poignet',
    thigh: 'hanche',
    shin: 'genou',
    foot: 'cheville',
    toes: 'orteils',
    thumb: 'pouce',
    index: 'index',
    middle: 'majeur',
    ring: 'annulaire',
    little: 'auriculaire',
    metacarpal: 'paume',
    proximal: '1re articulation',
    intermediate: '2e articulation',
    distal: '3e articulation',
    tip: 'bout',
    left: 'gauche',
    right: 'droite',
  },
}
const kDefects: Readonly<Record<Language, Messages>> = {
  en: {},
  fr: {
    'T-pose': 'pose en T',
    'frozen joint': 'articulation figée',
    jump: 'saut',
    'quaternion flip': 'quaternion inversé',
    'permuted root': 'racine permutée',
    scale: 'échelle',
    'not finite': 'nombres non finis',
  },
}

const kSides = ['left_', 'right_'] as const
const kSided = ['eye', 'clavicle', 'upper_arm', 'forearm', 'hand', 'thigh', 'shin', 'foot', 'toes']
const kFingers = ['thumb', 'index', 'middle', 'ring', 'little']
const kPoints = ['metacarpal', 'proximal', 'intermediate', 'distal', 'tip']
/** The body parts except fingers, by their names in docs/rig.md. */
export const kMainParts: readonly string[] = [
  'pelvis',
  'spine',
  'chest',
  'neck',
  'head',
  'head_top',
  'jaw',
  ...kSided.flatMap((part) => kSides.map((side) => side + part)),
]
export const kFingerParts: readonly string[] = kSides.flatMap((side) => kFingers.flatMap((finger) => kPoints.map((point) => `${side}${finger}_${point}`)))
/** The parts without which a body can hardly sign or be drawn. */
export const kNeeded: readonly string[] = [
  'pelvis',
  'chest',
  'neck',
  'head',
  ...['upper_arm', 'forearm', 'hand'].flatMap((part) => kSides.map((side) => side + part)),
]

/** Returns the readable name of a part, such as "left wrist". */
export function partName(part: string, language: Language): string {
  const parts = kParts[language]
  const side = part.startsWith('left_') ? parts.left : part.startsWith('right_') ? parts.right : ''
  const rest = part.replace(/^(left|right)_/, '')
  const finger = kFingers.find((one) => rest.startsWith(`${one}_`))
  const plain = finger ? `${parts[finger]}, ${parts[rest.slice(finger.length + 1)]}` : (parts[rest] ?? rest)
  if (!side) return plain
  return language === 'en' ? `${side} ${plain}` : `${plain} à ${side}`
}

export const defectName = (kind: string, language: Language): string => kDefects[language][kind] ?? kind
