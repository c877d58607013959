import { typeset } from '../text/typeset'

/** `title` is the name of a step, `now` the instruction. `{…}` is replaced by the subject of the path. */
interface StepMessages {
  readonly title: string
  readonly now: string
}

const en = {
  title: 'First steps',
  intro:
    'Two paths of about five minutes. You do each step in the studio itself; a panel at the top follows you, says what to do, and notices when ' +
    'it is done.',
  path_demo: 'I have only the demo',
  path_own: 'I have a folder of EAF and BVH files',
  line_demo: 'View, search, compose and evaluate with the content of this database.',
  line_own: 'Import your recordings, check them, find signs, propose phases, compose, export.',
  begin: 'Begin',
  goOn: 'Continue',
  again: 'Start over',
  minutes: 'about 5 minutes',
  empty: 'This database is empty. Import recordings first: the second path shows how.',
  toImport: 'Import recordings',
  readOnly: 'This database is served read-only. To import, serve a writable one:',
  otherDatabase: 'Writable databases:',
  stepOf: 'Step {n} of {all}',
  here: 'Go there',
  back: 'Previous step',
  next: 'Next',
  doneButton: 'Done',
  skip: 'Skip',
  leave: 'Leave the guide',
  fold: 'Collapse',
  unfold: 'Expand',
  panel: 'Guide',
  stepDone: 'Done: {title}.',
  alreadyDone: 'Already done.',
  over: 'This was the last step.',
  overNow: 'You have seen every part of the studio. The help (?) lists all shortcuts.',
  otherPath: 'The other path',
  stepIsDone: 'done',
  steps: {
    open: { title: 'Open a recording', now: 'Open {recording}: click its name in the list of recordings.' },
    slow: { title: 'Play it slowly', now: 'Set Speed to 0.5 (the slider, or <) and press Play (or Space).' },
    select: { title: 'Select a sign', now: 'Click a gloss on the timeline, or press G: the sign repeats.' },
    search: { title: 'Search for a gloss', now: 'Type gloss = "{gloss}" into the search field and press Enter.' },
    grid: { title: 'View its tokens', now: 'Select the grid: all tokens of the gloss play next to each other.' },
    compose: { title: 'Compose a sentence', now: 'Type two or more glosses, such as {gloss} and another one from the list.' },
    token: { title: 'Choose another token', now: 'Select a place and choose another of its tokens: the costs show how well each one fits.' },
    transition: { title: 'Change a transition', now: 'Select a junction between two signs and give it another method, duration or tempo.' },
    save: { title: 'Download or share', now: 'Download BVH, GLB or EAF, or copy the link and press Done.' },
    evaluate: { title: 'Evaluate', now: 'Press Evaluate: every method regenerates captured transitions, and the results are compared.' },
    drop: { title: 'Add your files', now: 'Drop your folder of EAF and BVH files onto the page, or choose it, and have it inspected.' },
    report: { title: 'Check the report', now: 'Check the guesses: pairs of files, tiers, axes, unit, rig, defects. Then press Done.' },
    correct: {
      title: 'Correct a guess',
      now: 'Correct a wrong guess, such as a tier or the unit, and check the new report. Nothing is wrong? Skip this step.',
    },
    store: { title: 'Store them', now: 'Import the recordings that are right.' },
    openOwn: { title: 'Open one', now: 'Open one of your recordings and view it.' },
    find: { title: 'Find a sign', now: 'Search for one of your glosses, such as gloss = "…".' },
    propose: { title: 'Propose phases', now: 'In the list of recordings, press Show next to one, then Phases: they are proposed from the motion.' },
    check: { title: 'Check some', now: 'Accept, move or reject some of them and save. Proposals are not annotation until a person has checked them.' },
    composeOwn: { title: 'Compose with it', now: 'Type one of your glosses.' },
    export: { title: 'Export', now: 'Download your composition as BVH, GLB or EAF.' },
  } satisfies Readonly<Record<string, StepMessages>>,
}
type Messages = { readonly [key in keyof typeof en]: (typeof en)[key] extends string ? string : { readonly [id in keyof (typeof en)['steps']]: StepMessages } }

const fr: Messages = {
  title: 'Premiers pas',
  intro:
    'Deux parcours d’environ cinq minutes. Chaque étape se fait dans le studio même ; un bandeau en haut vous accompagne, indique quoi faire et ' +
    'remarque quand c’est fait.',
  path_demo: 'Je n’ai que la démo',
  path_own: 'J’ai un dossier de fichiers EAF et BVH',
  line_demo: 'Regarder, chercher, composer et évaluer avec le contenu de cette base.',
  line_own: 'Importer vos enregistrements, les vérifier, trouver des signes, proposer des phases, composer, exporter.',
  begin: 'Commencer',
  goOn: 'Continuer',
  again: 'Recommencer',
  minutes: 'environ 5 minutes',
  empty: 'Cette base est vide. Importez d’abord des enregistrements : le second parcours montre comment.',
  toImport: 'Importer des enregistrements',
  readOnly: 'Cette base n’est servie qu’en lecture. Pour importer, servez-en une modifiable :',
  otherDatabase: 'Bases modifiables :',
  stepOf: 'Étape {n} sur {all}',
  here: 'Y aller',
  back: 'Étape précédente',
  next: 'Suivant',
  doneButton: 'Fait',
  skip: 'Passer',
  leave: 'Quitter le guide',
  fold: 'Réduire',
  unfold: 'Agrandir',
  panel: 'Guide',
  stepDone: 'Fait : {title}.',
  alreadyDone: 'Déjà fait.',
  over: 'C’était la dernière étape.',
  overNow: 'Vous avez vu toutes les parties du studio. L’aide (?) liste tous les raccourcis.',
  otherPath: 'L’autre parcours',
  stepIsDone: 'fait',
  steps: {
    open: { title: 'Ouvrir un enregistrement', now: 'Ouvrez {recording} : cliquez sur son nom dans la liste des enregistrements.' },
    slow: { title: 'Le lire lentement', now: 'Réglez la vitesse à 0,5 (avec le curseur, ou <) et lancez la lecture (ou appuyez sur Espace).' },
    select: { title: 'Sélectionner un signe', now: 'Cliquez sur une glose de la chronologie, ou tapez G : le signe est répété.' },
    search: { title: 'Chercher une glose', now: 'Tapez gloss = "{gloss}" dans le champ de recherche, puis Entrée.' },
    grid: { title: 'Regarder ses occurrences', now: 'Choisissez la grille : toutes les occurrences de la glose sont lues côte à côte.' },
    compose: { title: 'Composer une phrase', now: 'Tapez au moins deux gloses, par exemple {gloss} et une autre de la liste.' },
    token: { title: 'Choisir une autre occurrence', now: 'Sélectionnez une place et choisissez une autre occurrence : les coûts indiquent laquelle convient.' },
    transition: { title: 'Changer une transition', now: 'Sélectionnez une jonction entre deux signes et changez sa méthode, sa durée ou son tempo.' },
    save: { title: 'Télécharger ou partager', now: 'Téléchargez BVH, GLB ou EAF, ou copiez le lien puis appuyez sur Fait.' },
    evaluate: { title: 'Évaluer', now: 'Appuyez sur Évaluer : chaque méthode régénère des transitions captées, et les résultats sont comparés.' },
    drop: { title: 'Ajouter vos fichiers', now: 'Déposez votre dossier de fichiers EAF et BVH sur la page, ou choisissez-le, et faites-le examiner.' },
    report: {
      title: 'Vérifier le rapport',
      now: 'Vérifiez ce qui a été deviné : paires de fichiers, pistes, axes, unité, squelette, défauts. Puis appuyez sur Fait.',
    },
    correct: {
      title: 'Corriger',
      now: 'Corrigez ce qui a été mal deviné, par exemple une piste ou l’unité, et vérifiez le nouveau rapport. Tout est juste ? Passez.',
    },
    store: { title: 'Les stocker', now: 'Importez les enregistrements qui sont justes.' },
    openOwn: { title: 'En ouvrir un', now: 'Ouvrez un de vos enregistrements et regardez-le.' },
    find: { title: 'Trouver un signe', now: 'Cherchez une de vos gloses, par exemple gloss = "…".' },
    propose: {
      title: 'Proposer des phases',
      now: 'Dans la liste des enregistrements, appuyez sur Afficher, puis sur Phases : elles sont proposées d’après le mouvement.',
    },
    check: {
      title: 'En vérifier',
      now: 'Acceptez, déplacez ou rejetez-en quelques-unes et enregistrez. Une proposition n’est pas une annotation tant que personne ne l’a vérifiée.',
    },
    composeOwn: { title: 'Composer avec', now: 'Tapez une de vos gloses.' },
    export: { title: 'Exporter', now: 'Téléchargez ce que vous avez composé en BVH, GLB ou EAF.' },
  },
}
export const messages = { en, fr: typeset(fr) }
export type GuideMessages = Messages
export const stepMessages = (text: Messages, id: string): StepMessages => (text.steps as Readonly<Record<string, StepMessages>>)[id]
