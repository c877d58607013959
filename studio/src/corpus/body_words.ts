/// Words for parts of the body and for what is wrong with a motion, as reports of the server name them.

type Language = 'en' | 'fr'
interface Words {
  readonly [name: string]: string
}

const kParts: Readonly<Record<Language, Words>> = {
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
const kDefects: Readonly<Record<Language, Words>> = {
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
/** The parts of a body but for fingers, as docs/rig.md names them. */
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
/** Parts without which a body can hardly sign, or be drawn. */
export const kNeeded: readonly string[] = [
  'pelvis',
  'chest',
  'neck',
  'head',
  ...['upper_arm', 'forearm', 'hand'].flatMap((part) => kSides.map((side) => side + part)),
]

/** A part in plain words: "left wrist". */
export function partWords(part: string, language: Language): string {
  const words = kParts[language]
  const side = part.startsWith('left_') ? words.left : part.startsWith('right_') ? words.right : ''
  const rest = part.replace(/^(left|right)_/, '')
  const finger = kFingers.find((one) => rest.startsWith(`${one}_`))
  const plain = finger ? `${words[finger]}, ${words[rest.slice(finger.length + 1)]}` : (words[rest] ?? rest)
  if (!side) return plain
  return language === 'en' ? `${side} ${plain}` : `${plain} à ${side}`
}

export const defectWords = (kind: string, language: Language): string => kDefects[language][kind] ?? kind
