import { typeset } from '../text/typeset'

const en = {
  title: 'Captured signing, kept as motion and as meaning',
  is:
    'signweave is a database of captured signing. It keeps how hands, body and face moved, and what was signed. It finds signs by either, and makes ' +
    'new signing from what was captured.',
  isNot:
    'It does not translate, and it is no interpreter: it signs the glosses that you give it, in your order, with movements that were captured. No Deaf ' +
    'viewer has judged the result yet.',
  motion: 'Motion',
  meaning: 'Meaning',
  made: 'New signing',
  ways: 'Where to begin',
  demo: 'Look at the demo',
  demoWhat: 'Recordings of a synthetic signer, to try everything with. They show what the studio does, and nothing of a sign language.',
  openDemo: 'Open {name}',
  composeDemo: 'Compose from it',
  own: 'Use your own files',
  ownWhat: 'Drop recordings and annotation anywhere on this page, files or folders: BVH, FBX, glTF, EAF and more. You see what would be stored before it is.',
  importInto: 'Import into {name}',
  readOnly: 'The server may only read its databases. Serve one that may be changed:',
  guide: 'Take the first steps',
  guideWhat: 'Five minutes through the studio, a step at a time, with what is here or with a folder of your own.',
  guideGo: 'First steps',
  databases: 'Databases here',
  one: '1 recording',
  many: '{n} recordings',
  empty: 'empty',
  changeable: 'may be changed',
  reading: 'for reading only',
  noneTitle: 'No database is served here yet',
  noneWhat: 'Make one, put recordings in, and serve it:',
}
type Words = { readonly [key in keyof typeof en]: string }
const fr: Words = {
  title: 'Des signes captés, gardés comme mouvement et comme sens',
  is:
    'signweave est une base de données de langue des signes captée. Elle garde comment les mains, le corps et le visage ont bougé, et ce qui a été signé. ' +
    'Elle trouve des signes par l’un ou par l’autre, et en compose de nouveaux énoncés signés.',
  isNot:
    'Elle ne traduit pas et ne remplace aucun interprète : elle signe les gloses que vous lui donnez, dans votre ordre, avec des mouvements captés. Aucun ' +
    'spectateur sourd n’a encore jugé le résultat.',
  motion: 'Mouvement',
  meaning: 'Sens',
  made: 'Nouvel énoncé',
  ways: 'Par où commencer',
  demo: 'Regarder la démo',
  demoWhat: 'Des enregistrements d’un signeur synthétique, pour tout essayer. Ils montrent ce que fait le studio, et rien d’une langue des signes.',
  openDemo: 'Ouvrir {name}',
  composeDemo: 'Composer avec',
  own: 'Prendre vos propres fichiers',
  ownWhat:
    'Déposez enregistrements et annotations n’importe où sur cette page, fichiers ou dossiers : BVH, FBX, glTF, EAF et d’autres. Vous voyez ce qui serait ' +
    'stocké avant que ce le soit.',
  importInto: 'Importer dans {name}',
  readOnly: 'Le serveur peut seulement lire ses bases. Servez-en une qui peut changer :',
  guide: 'Faire les premiers pas',
  guideWhat: 'Cinq minutes à travers le studio, pas à pas, avec ce qui est ici ou avec un dossier à vous.',
  guideGo: 'Premiers pas',
  databases: 'Bases servies ici',
  one: '1 enregistrement',
  many: '{n} enregistrements',
  empty: 'vide',
  changeable: 'peut changer',
  reading: 'en lecture seule',
  noneTitle: 'Aucune base n’est encore servie ici',
  noneWhat: 'Créez-en une, mettez-y des enregistrements et servez-la :',
}
export const words = { en, fr: typeset(fr) }
