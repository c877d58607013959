// Builds one character: gathered once, written in all requested variants.
import { gather } from './shape/character.js';
import { writeGlb } from './glb/write.js';
import { extrasOf } from './rig/extras.js';
import { materialsOf } from './surface/materials.js';

/**
 * @param {string} name `woman` or `man`
 * @param {Array<{ small: boolean }>} kinds small: meshopt, integers, WebP; otherwise only features of plain glTF
 * @returns {Promise<Uint8Array[]>} one GLB for each kind
 */
export async function buildCharacter(name, kinds) {
  const character = gather(name);
  const extras = extrasOf(character);
  const materials = materialsOf(character);
  const out = [];
  for (const { small } of kinds) out.push(await writeGlb(character, { small, extras, materials }));
  return out;
}
