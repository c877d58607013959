// build_character.js [--plain] OUT_FOLDER [woman|man]…: writes woman.glb and man.glb, with --plain also woman.plain.glb and man.plain.glb, which need no
// extension and are several times as large.
import fs from 'node:fs';
import path from 'node:path';
import { buildCharacter } from './build.js';
import { PEOPLE } from './shape/people.js';

const words = process.argv.slice(2);
const plain = words.includes('--plain');
const [folder, ...names] = words.filter((word) => word !== '--plain');
if (!folder || words.some((word) => word.startsWith('-') && word !== '--plain')) {
  console.error('build_character.js [--plain] OUT_FOLDER [woman|man]…');
  process.exit(2);
}
fs.mkdirSync(folder, { recursive: true });
for (const name of names.length > 0 ? names : Object.keys(PEOPLE)) {
  const kinds = plain ? [{ small: true }, { small: false }] : [{ small: true }];
  const written = await buildCharacter(name, kinds);
  written.forEach((bytes, k) => {
    const file = path.join(folder, `${name}${kinds[k].small ? '' : '.plain'}.glb`);
    fs.writeFileSync(`${file}.part`, bytes);
    fs.renameSync(`${file}.part`, file); // atomically
    console.log(`${file}: ${bytes.length} bytes`);
  });
}
