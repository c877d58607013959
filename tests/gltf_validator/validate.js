// validate.js FILE…: runs the Khronos validator over glTF files. Fails on an error or a warning, and on what should be there
// and is not: every file must have an animation and a skin.
const fs = require('fs');
const path = require('path');
const validator = require('gltf-validator');

async function check(file) {
  const bytes = new Uint8Array(fs.readFileSync(file));
  const report = await validator.validateBytes(bytes, { uri: path.basename(file), maxIssues: 20 });
  const { numErrors, numWarnings, messages } = report.issues;
  for (const issue of messages) {
    if (issue.severity < 2) console.log(`${file}: ${issue.code} at ${issue.pointer}: ${issue.message}`);
  }
  const moves = report.info.animationCount === 1 && report.info.hasSkins;
  if (!moves) console.log(`${file}: no animation or no skin`);
  console.log(`${path.basename(file)}: ${numErrors} errors, ${numWarnings} warnings`);
  return numErrors === 0 && numWarnings === 0 && moves;
}

(async () => {
  const files = process.argv.slice(2);
  if (files.length === 0) throw new Error('no file given');
  let good = true;
  for (const file of files) good = (await check(file)) && good;
  process.exit(good ? 0 : 1);
})().catch((error) => {
  console.error(`validate.js: ${error.message}`);
  process.exit(1);
});
