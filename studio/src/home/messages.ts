import { typeset } from '../text/typeset'

const en = {
  title: 'Captured signing, stored as motion and as meaning',
  is:
    'signweave is a database of captured signing. It stores how hands, body and face moved, and what was signed. It finds signs by either, and ' +
    'builds new signing from captured pieces.',
  isNot:
    'It does not translate, and it is not an interpreter: it signs the glosses that you give it, in your order, with captured movements. No Deaf ' +
    'viewer has judged the result yet.',
  motion: 'Motion',
  meaning: 'Meaning',
  made: 'New signing',
  entries: 'Where to start',
  demo: 'Explore the demo',
  demoWhat: 'Recordings of a synthetic signer, to try everything with. They show what the studio does, but are not examples of a sign language.',
  openDemo: 'Open {name}',
  composeDemo: 'Compose with it',
  own: 'Use your own files',
  ownWhat:
    'Drop recordings and annotation anywhere on this page, files or folders: BVH, FBX, glTF, EAF and more. You see what would be stored before ' +
    'anything is stored.',
  importInto: 'Import into {name}',
  readOnly: 'The server has read-only access to its databases. Serve a writable one:',
  guide: 'Take the first steps',
  guideWhat: 'A five-minute tour of the studio, step by step, with these recordings or with your own folder.',
  guideGo: 'First steps',
  databases: 'Databases here',
  one: '1 recording',
  many: '{n} recordings',
  empty: 'empty',
  changeable: 'writable',
  reading: 'read-only',
  noneTitle: 'No database is served here yet',
  noneWhat: 'Create one, import recordings, and serve it:',
}
type Messages = { readonly [key in keyof typeof en]: string }
const fr: Messages = {
  title: 'La langue des signes captée, stockée comme mouvement et comme sens',
  is:
    'signweave est une base de données de langue des signes captée. Elle enregistre comment les mains, le corps et le visage ont bougé, et ce ' +
    'qui a été signé. Elle retrouve des signes par l’un ou par l’autre, et compose de nouveaux énoncés à partir d’extraits captés.',
  isNot:
    'Elle ne traduit pas et ne remplace aucun interprète : elle signe les gloses que vous lui donnez, dans votre ordre, avec des mouvements captés. Aucun ' +
    'spectateur sourd n’a encore jugé le résultat.',
  motion: 'Mouvement',
  meaning: 'Sens',
  made: 'Nouvel énoncé',
  entries: 'Par où commencer',
  demo: 'Explorer la démo',
  demoWhat:
    'Des enregistrements d’un signeur synthétique, pour tout essayer. Ils montrent ce que fait le studio, mais ne sont pas des exemples de ' +
    'langue des signes.',
  openDemo: 'Ouvrir {name}',
  composeDemo: 'Composer avec',
  own: 'Utiliser vos propres fichiers',
  ownWhat:
    'Déposez enregistrements et annotations n’importe où sur cette page, fichiers ou dossiers : BVH, FBX, glTF, EAF et d’autres. Vous voyez ce ' +
    'qui serait stocké avant que rien ne le soit.',
  importInto: 'Importer dans {name}',
  readOnly: 'Le serveur n’a accès à ses bases qu’en lecture. Servez-en une modifiable :',
  guide: 'Faire les premiers pas',
  guideWhat: 'Une visite du studio en cinq minutes, étape par étape, avec ces enregistrements ou avec votre propre dossier.',
  guideGo: 'Premiers pas',
  databases: 'Bases servies ici',
  one: '1 enregistrement',
  many: '{n} enregistrements',
  empty: 'vide',
  changeable: 'modifiable',
  reading: 'en lecture seule',
  noneTitle: 'Aucune base n’est servie ici pour l’instant',
  noneWhat: 'Créez-en une, importez-y des enregistrements et servez-la :',
}
export const messages = { en, fr: typeset(fr) }
