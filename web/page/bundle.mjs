// SPDX-License-Identifier: MIT
// Makes the page, static files, of src/ and the package of npm.
//
// Usage: node bundle.mjs PACKAGE VIEWER FOLDER
//
// PACKAGE is build/wasm/package, VIEWER the page that reports are written with. FOLDER is made anew. Exit code 77: esbuild is not
// installed (npm ci in web/viewer).
import {createHash} from 'node:crypto';
import {copyFile, mkdir, readFile, readdir, rm, writeFile} from 'node:fs/promises';
import {createRequire} from 'node:module';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

const folder = dirname(fileURLToPath(import.meta.url));
const [packed, viewer, target] = process.argv.slice(2).map((name) => resolve(name));

function esbuild() {
  try {
    return createRequire(join(folder, '../viewer/package.json'))('esbuild');
  } catch (error) {
    console.error(`the packages of web/viewer are not installed: ${error.code}`);
    process.exit(77);
  }
}

// The page shows pages of --html in a frame, which has this policy, too: their script and style are known by their hashes.
async function policy() {
  const [, script, style] = /script-src ('sha256-[^']+'); style-src ('sha256-[^']+')/.exec(await readFile(viewer, 'utf8'));
  return [
    "default-src 'none'", `script-src 'self' 'wasm-unsafe-eval' ${script}`, `style-src 'self' ${style}`, "connect-src 'self'", "worker-src 'self'",
    "img-src 'self'", 'frame-src blob:', "base-uri 'none'", "form-action 'none'",
  ].join('; ');
}

const {build} = esbuild();
await rm(target, {recursive: true, force: true});
await mkdir(target, {recursive: true});
const common = {bundle: true, minify: true, format: 'esm', target: 'es2022', charset: 'ascii', legalComments: 'none', absWorkingDir: folder};
await build({...common, entryPoints: [join(folder, 'src/main.js')], outfile: join(target, 'page.js'), alias: {meshrepair: join(packed, 'browser.js')}});
await build({...common, entryPoints: [join(packed, 'worker-browser.js')], outfile: join(target, 'worker-browser.js')});
for (const name of ['meshrepair.wasm', 'NOTICE', 'LICENSE']) await copyFile(join(packed, name), join(target, name));
for (const name of ['page.css', 'icon.svg']) await copyFile(join(folder, 'src', name), join(target, name));
await writeFile(join(target, 'index.html'), (await readFile(join(folder, 'src/index.html'), 'utf8')).replace('@POLICY@', await policy()));

const names = (await readdir(target)).sort();
const hash = createHash('sha256');
for (const name of names) hash.update(name).update(await readFile(join(target, name)));
const offline = (await readFile(join(folder, 'src/offline.js'), 'utf8'))
    .replace('@HASH@', hash.digest('hex').slice(0, 16)).replace('@FILES@', JSON.stringify(['./', ...names.map((name) => `./${name}`)]));
await writeFile(join(target, 'offline.js'), offline);
