// SPDX-License-Identifier: MIT
// For tests of the package of npm: installs it as its users do, and a mesh to wait for.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, realpathSync, rmSync, writeFileSync} from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {after} from 'node:test';

export function skip(why) {
  console.log(why);
  process.exit(77);
}

// Installs the package of `folder` in a new folder `place`; `bin` holds its programs.
export function install(folder) {
  if (!existsSync(path.join(folder, 'bin/meshrepair.js'))) skip('there is no package: scripts/make_wasm.sh makes it');
  if (spawnSync('npm', ['--version']).status !== 0) skip('there is no npm');
  const place = realpathSync(mkdtempSync(path.join(os.tmpdir(), 'meshrepair-npm-')));
  after(() => rmSync(place, {recursive: true}));
  const npm = (...words) => {
    const {status, stderr, stdout} = spawnSync('npm', words, {cwd: place, encoding: 'utf8'});
    assert.equal(status, 0, stderr);
    return stdout;
  };
  const packed = JSON.parse(npm('pack', '--json', '--offline', folder))[0].filename;
  writeFileSync(path.join(place, 'package.json'), '{}');
  npm('install', '--offline', '--no-audit', '--no-fund', `./${packed}`);
  return {place, bin: path.join(place, 'node_modules/.bin')};
}

// Takes long to repair.
export function writeSoup(name, count = 20000) {
  const bytes = Buffer.alloc(84 + 50 * count);
  bytes.writeUInt32LE(count, 80);
  let state = 1;
  const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
  for (let i = 0; i < count; ++i) {
    const centre = [random(), random(), random()];
    for (let k = 0; k < 9; ++k) bytes.writeFloatLE(centre[k % 3] + 0.1 * random(), 84 + 50 * i + 12 + 4 * k);
  }
  writeFileSync(name, bytes);
}
