// SPDX-License-Identifier: MIT
// Makes the page that reports are written with: all of src/ and three.js in one file.
//
// Usage: node bundle.mjs FILE
//
// Exit code 77: the packages are not installed (npm ci).
import {createHash} from 'node:crypto';
import {readFile, writeFile} from 'node:fs/promises';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const folder = dirname(fileURLToPath(import.meta.url));

async function esbuild() {
  try {
    return await import('esbuild');
  } catch (error) {
    console.error(`the packages of web/viewer are not installed: ${error.code}`);
    process.exit(77);
  }
}

// Nothing may end the element that the text stands in.
function checked(text) {
  if (/<\/(script|style)|<!--/i.test(text)) throw new Error('the bundle has what ends its element');
  return text.trim();
}

function hash(text) {
  return `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
}

const {build, transform} = await esbuild();
const bundle = await build({entryPoints: [join(folder, 'src/main.js')], bundle: true, minify: true, write: false, format: 'iife',
  target: 'es2022', charset: 'ascii', legalComments: 'none', absWorkingDir: folder});
const licence = (await readFile(join(folder, 'node_modules/three/LICENSE'), 'utf8')).trim();
const script = checked(`/* This file contains three.js:\n${licence}\n*/\n${bundle.outputFiles[0].text}`);
const style = checked((await transform(await readFile(join(folder, 'src/viewer.css'), 'utf8'), {loader: 'css', minify: true, charset: 'ascii'})).code);
const policy = `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; base-uri 'none'; form-action 'none'`;
let page = await readFile(join(folder, 'src/page.html'), 'utf8');
for (const [name, text] of Object.entries({POLICY: policy, STYLE: style, SCRIPT: script})) page = page.replace(`@${name}@`, () => text);
await writeFile(process.argv[2], page);
