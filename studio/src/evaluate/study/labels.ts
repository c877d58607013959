import { kLabels, type Label, type Labels } from './study'

/** What stands on the screens of a study where its maker wrote nothing else. */
export const kDefaultLabels: Labels = {
  intro: {
    en:
      'You will see short pieces of signing, two at a time. One was recorded from a person. In the other a part was made by a computer. ' +
      'Look as often as you like.',
    fr:
      'Vous allez voir de courts extraits de signes, deux à la fois. L’un a été enregistré d’une personne. ' +
      'Dans l’autre, une partie a été composée par ordinateur. Regardez aussi souvent que vous voulez.',
  },
  recorded: { en: 'Which was recorded from a person?', fr: 'Lequel a été enregistré d’une personne ?' },
  natural: { en: 'Which looks more natural?', fr: 'Lequel paraît le plus naturel ?' },
  person: { en: 'Recorded', fr: 'Enregistré' },
  machine: { en: 'Made by a computer', fr: 'Composé par ordinateur' },
  rating: { en: 'How sure are you?', fr: 'À quel point êtes-vous sûr ?' },
  low: { en: 'guessed', fr: 'au hasard' },
  high: { en: 'certain', fr: 'certain' },
  comment: { en: 'What did you see? (not needed)', fr: 'Qu’avez-vous vu ? (facultatif)' },
  code: { en: 'Your code', fr: 'Votre code' },
  fluency: { en: 'Sign language', fr: 'Langue des signes' },
  deaf: { en: 'Deaf signer', fr: 'Signeur sourd' },
  hearing: { en: 'Hearing signer', fr: 'Signeur entendant' },
  learner: { en: 'Learner', fr: 'Apprenant' },
  none: { en: 'None', fr: 'Aucune' },
  thanks: { en: 'That was all. Thank you!', fr: 'C’est tout. Merci !' },
}
/** Of one motion at a time. */
export const kSingleLabels: Pick<Labels, 'intro' | 'recorded' | 'rating' | 'low' | 'high'> = {
  intro: {
    en: 'You will see short pieces of signing. Some were recorded from a person. In others a part was made by a computer. Look as often as you like.',
    fr:
      'Vous allez voir de courts extraits de signes. Certains ont été enregistrés d’une personne. Dans d’autres, une partie a été composée par ordinateur. ' +
      'Regardez aussi souvent que vous voulez.',
  },
  recorded: { en: 'Recorded from a person, or made?', fr: 'Enregistré d’une personne, ou composé ?' },
  rating: { en: 'How natural does it look?', fr: 'Est-ce que cela paraît naturel ?' },
  low: { en: 'not at all', fr: 'pas du tout' },
  high: { en: 'completely', fr: 'tout à fait' },
}

export const defaultsOf = (mode: 'pair' | 'single'): Labels => (mode === 'single' ? { ...kDefaultLabels, ...kSingleLabels } : kDefaultLabels)

/** Those of a study, with what was written; an empty one is as it would be. */
export function labelsOf(mode: 'pair' | 'single', written: Readonly<Partial<Record<Label, { en?: string; fr?: string }>>>): Labels {
  const defaults = defaultsOf(mode)
  return Object.fromEntries(
    kLabels.map((label) => [label, { en: written[label]?.en?.trim() || defaults[label].en, fr: written[label]?.fr?.trim() || defaults[label].fr }]),
  ) as unknown as Labels
}
