// SPDX-License-Identifier: MIT
// Compares what the package of npm makes of files with what the program makes of them, byte by byte, and how long both take.
//
// Usage: node same_bytes.mjs PACKAGE PROGRAM FORMAT[,FORMAT...] FILE... [-- OPTION=VALUE...]
//
// PACKAGE is the folder of the package, as build/wasm/package. A FILE that is a folder stands for all files in it. Both have to write the
// same bytes, or to fail with the same exit code and message. Exit code 0: they do, 1: they differ, 77: there is no package.

import {spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const words = process.argv.slice(2);
const end = words.includes('--') ? words.indexOf('--') : words.length;
const [folder, named, formats, ...given] = words.slice(0, end);
const program = path.resolve(named);
const options = Object.fromEntries(words.slice(end + 1).map((word) => word.split(/=(.*)/s).slice(0, 2)));
if (!existsSync(path.join(folder, 'meshrepair.wasm'))) {
  console.log('there is no package: scripts/make_wasm.sh makes it');
  process.exit(77);
}
const {repair} = await import(pathToFileURL(path.resolve(folder, 'node.js')));
const work = mkdtempSync(path.join(tmpdir(), 'same_bytes_'));

function filesOf(name) {
  return statSync(name).isDirectory() ? readdirSync(name).sort().map((entry) => path.join(name, entry)) : [name];
}

// {code, message, bytes, seconds}
function byProgram(file, format) {
  const target = path.join(work, `mesh.${format}`);
  rmSync(target, {force: true});
  const more = Object.entries(options).map(([name, value]) => `--${name}=${value}`);
  const begin = performance.now();
  const {status, stderr} = spawnSync(program, ['-q', '--threads', '1', ...more, path.basename(file), target],
      {encoding: 'utf8', cwd: path.dirname(file)});
  const seconds = (performance.now() - begin) / 1000;
  const message = stderr.trim().split('\n').at(-1).replace(/^meshrepair: (\[error\] |error: )?/, '').split(' (try ')[0].replaceAll(`${work}/`, '');
  return {code: status, message, bytes: existsSync(target) ? readFileSync(target) : null, seconds};
}

function besides(file) {
  const names = readdirSync(path.dirname(file)).filter((name) => /\.(mtl|png|jpe?g|bin)$/i.test(name));
  return Object.fromEntries(names.map((name) => [name, readFileSync(path.join(path.dirname(file), name))]));
}

async function byPackage(file, format) {
  const bytes = readFileSync(file);
  const begin = performance.now();
  try {
    const made = await repair(bytes, {...options, from: path.basename(file), to: format, files: besides(file)});
    const seconds = (performance.now() - begin) / 1000;
    return {code: made.certified ? 0 : 1, message: made.error.replace(/^error: /, ''), bytes: Buffer.from(await made.bytes()), seconds};
  } catch (error) {
    return {code: error.exitCode ?? 70, message: error.message, bytes: null, seconds: (performance.now() - begin) / 1000};
  }
}

let [compared, differ, native, wasm] = [0, 0, 0, 0];
const ratios = [];
for (const file of given.flatMap(filesOf)) {
  for (const format of formats.split(',')) {
    const [a, b] = [byProgram(file, format), await byPackage(file, format)];
    ++compared;
    native += a.seconds;
    wasm += b.seconds;
    if (a.seconds > 0.2) ratios.push(b.seconds / a.seconds);
    const isSame = a.code === b.code && (a.bytes === null) === (b.bytes === null) && (a.bytes === null || a.bytes.equals(b.bytes)) &&
        (a.bytes !== null || a.message === b.message);
    if (!isSame) ++differ;
    const what = isSame ? 'same' : `DIFFERS: ${a.code} "${a.message}" ${a.bytes?.length}, ${b.code} "${b.message}" ${b.bytes?.length}`;
    if (!isSame || process.env.VERBOSE) {
      console.log(`${file} to ${format}: ${what} (${a.seconds.toFixed(2)} s, ${b.seconds.toFixed(2)} s)`);
    }
  }
}
rmSync(work, {recursive: true, force: true});
ratios.sort((a, b) => a - b);
console.log(`${compared} repairs: ${differ} differ; program ${native.toFixed(1)} s, package ${wasm.toFixed(1)} s, ` +
    `${(wasm / native).toFixed(2)} times` + (ratios.length ? `; of those over 0.2 s ${ratios[ratios.length >> 1].toFixed(2)} in the middle, ` +
    `${ratios.at(-1).toFixed(2)} at most` : ''));
process.exit(differ === 0 ? 0 : 1);
