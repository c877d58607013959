// look.js GLB OUT_FOLDER [PICTURE]…: renders the character in every pose and face of poses.js, as PNG, in headless Chromium.
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const FLAGS = [
  '--headless',
  '--no-sandbox',
  '--disable-gpu',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.glb': 'model/gltf-binary' };
const folder = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '..');

const [glb, out, ...wanted] = process.argv.slice(2);
if (!glb || !out) {
  console.error('look.js GLB OUT_FOLDER [PICTURE]…');
  process.exit(2);
}

/** Serves the page, its modules and the GLB, on loopback. */
const server = http.createServer((request, response) => {
  const name = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
  let file = path.join(folder, name.replace(/^\/modules\//, '/node_modules/'));
  if (name === '/character.glb') file = path.resolve(glb);
  else if (!file.startsWith(folder + path.sep)) file = '';
  if (!file || !fs.existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, { 'content-type': TYPES[path.extname(file)] ?? 'application/octet-stream' });
  fs.createReadStream(file).pipe(response);
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));

const data = fs.mkdtempSync(path.join(os.tmpdir(), 'look-'));
const context = await chromium.launchPersistentContext(data, {
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: FLAGS,
  viewport: { width: 1280, height: 900 },
});
try {
  const page = await context.newPage();
  page.on('console', (message) => message.type() === 'error' && console.error(message.text()));
  page.on('pageerror', (error) => console.error(error.message));
  await page.goto(`http://127.0.0.1:${server.address().port}/look/page.html`);
  await page.waitForFunction('window.ready', null, { timeout: 60000 });
  await page.evaluate('show("/character.glb")');
  fs.mkdirSync(out, { recursive: true });
  const names = wanted.length > 0 ? wanted : await page.evaluate('names');
  for (const name of names) {
    const view = await page.evaluate((each) => window.viewName(each), name);
    const [width, height] = /^(face|faceSide|hand)$/.test(view) ? [800, 800] : [1280, 900];
    await page.evaluate(([each, w, h]) => window.draw(each, w, h), [name, width, height]);
    const url = await page.evaluate('document.querySelector("canvas").toDataURL("image/png")');
    fs.writeFileSync(path.join(out, `${name}.png`), Buffer.from(url.split(',')[1], 'base64'));
  }
  console.log(`${names.length} pictures in ${out}`);
} finally {
  await context.close();
  server.close();
  fs.rmSync(data, { recursive: true, force: true });
}
