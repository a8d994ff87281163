// SPDX-License-Identifier: MIT
// Installs the package of npm as its users do, and compares its programs with the native ones.
//
// Usage: node use_programs.mjs PACKAGE PROGRAMS MESHES INPUTS
//
// PACKAGE is the folder of the package, as build/wasm/package, PROGRAMS that of the native programs. Exit code 77: there is no package, or
// no npm.

import assert from 'node:assert/strict';
import {spawn, spawnSync} from 'node:child_process';
import {cpSync, existsSync, mkdtempSync, mkdirSync, readFileSync, readdirSync, writeFileSync} from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import test from 'node:test';
import {install, writeSoup} from './npm_package.mjs';

const [folder, programs, meshes, inputs] = process.argv.slice(2).map((name) => path.resolve(name));
const {place, bin} = install(folder);

// Both in folders of their own, with copies of the same files.
function compared(name, words, {input = '', files = {}, stderr = true} = {}) {
  const [ours, native] = [bin, programs].map((from) => {
    const cwd = path.join(mkdtempSync(path.join(place, 'run-')), 'here');
    mkdirSync(cwd);
    for (const [file, source] of Object.entries(files)) cpSync(source, path.join(cwd, file));
    const done = spawnSync(path.join(from, name), words, {cwd, input});
    const left = Object.fromEntries(readdirSync(cwd).sort().map((file) => [file, readFileSync(path.join(cwd, file))]));
    return {status: done.status, stdout: done.stdout, stderr: stderr ? String(done.stderr).replace(/in [\d.]+ s\b/g, 'in s') : '', left};
  });
  assert.equal(ours.status, native.status, `${name} ${words.join(' ')}: ${ours.stderr}`);
  assert.equal(ours.stderr, native.stderr);
  assert.deepEqual(Object.keys(ours.left), Object.keys(native.left));
  assert.ok(ours.stdout.equals(native.stdout), `${name} ${words.join(' ')}: other standard output`);
  for (const [file, bytes] of Object.entries(ours.left)) assert.ok(bytes.equals(native.left[file]), `${name}: ${file} differs`);
  return ours;
}

const mesh = (name) => path.join(meshes, name);
const torus = {files: {'in.stl': mesh('broken_torus_box.stl')}};

test('each program is there, with its help', () => {
  for (const name of readdirSync(path.join(folder, 'bin')).map((file) => file.replace(/\.js$/, ''))) {
    assert.equal(spawnSync(path.join(bin, name), ['--version']).status, 0, name);
    compared(name, ['--help']);
  }
});

test('what is wrong has the exit codes and words of the native programs', () => {
  const cases = [
    ['meshrepair', []], ['meshrepair', ['in.stl']], ['meshrepair', ['none.stl', 'out.stl']], ['meshrepair', ['in.stl', 'out.xyz']],
    ['meshrepair', ['--no-such', 'in.stl', 'out.stl']], ['meshrepair', ['in.stl', 'none/out.stl']], ['meshrepair', ['.', 'out.stl']],
    ['meshrepair', ['in.stl', '.']], ['meshrepair', ['empty.stl', 'out.stl']], ['meshrepair', ['in.stl', 'out.stl', '--max-hole', 'x']],
    ['meshrepair', ['in.stl', 'out.stl', '--max-memory', '1M']], ['meshrepair', ['in.stl', 'in.stl', '--report', 'in.stl']],
    ['meshrepair', ['text.obj', 'out.obj']], ['meshrepair', ['in.stl', 'out.obj', '--report', 'none/r.json']],
    ['meshcheck', ['in.stl']], ['meshcheck', ['none.stl']], ['meshcheck', []], ['meshconvert', ['in.stl', 'out.abc']],
    ['meshdist', ['in.stl', 'none.stl']], ['meshdist', ['-', '-']], ['bspbool', ['in.stl', '--op', 'union', '-o', 'out.stl']],
    ['pointmesh', ['in.stl', 'out.stl']], ['bspsolid', ['in.stl', '-o', 'out.bsp']],
  ];
  writeFileSync(path.join(place, 'empty.stl'), '');
  writeFileSync(path.join(place, 'text.obj'), 'v 0 0 0\nf 1 2 9\n');
  const files = {...torus.files, 'empty.stl': path.join(place, 'empty.stl'), 'text.obj': path.join(place, 'text.obj')};
  for (const [name, words] of cases) compared(name, words, {files, stderr: !words.includes('--max-memory')});
});

test('files are those of the native programs', () => {
  compared('meshrepair', ['in.stl', 'out.stl', '--for', 'print'], torus);
  compared('meshrepair', ['in.stl', 'in.stl'], torus);
  compared('meshrepair', ['in.stl', 'out.obj', '--picture', 'out.png', '--explain', 'why.ply'], torus);
  compared('meshconvert', ['in.stl', 'out.3mf'], torus);
  compared('meshdist', ['in.stl', 'in.stl', '--html', 'page.html'], torus);
  compared('bspbuild', ['in.stl', '-o', 'out.bsp'], torus);
  compared('bspbool', ['in.stl', 'in.stl', '--op', 'union', '-o', 'out.ply'], torus);
});

test('materials and pictures beside a mesh are found, and written', () => {
  const files = Object.fromEntries(readdirSync(inputs).filter((name) => /^textured\.obj$|\.mtl$|\.png$|\.jpg$/.test(name)).map(
      (name) => [name, path.join(inputs, name)]));
  const {left} = compared('meshconvert', ['textured.obj', 'out.glb'], {files});
  assert.ok(left['out.glb'].length > 0);
});

test('standard input and output are read and written', () => {
  const input = readFileSync(mesh('broken_torus_box.stl'));
  compared('meshrepair', ['-', '-', '--format', 'stl'], {input});
  compared('meshcheck', ['-', '--mark', '-'], {input, stderr: false});
  compared('meshrepair', ['-', '-', '--format', 'stl']);
});

function ended(child) {
  return new Promise((done) => child.on('exit', (code, signal) => done(signal ? 128 + os.constants.signals[signal] : code)));
}

async function interrupted(name, words, stdio, begun) {
  const cwd = mkdtempSync(path.join(place, 'stop-'));
  writeSoup(path.join(cwd, 'soup.stl'));
  const child = spawn(path.join(bin, name), words, {cwd, stdio});
  const end = ended(child);
  await begun(child, cwd);
  child.kill('SIGINT');
  assert.equal(await end, 130);
  assert.deepEqual(readdirSync(cwd), ['soup.stl']);
}

const told = (child) => new Promise((done) => child.stdio[3].once('data', done));

test('Ctrl-C ends a program with 130, and nothing is left', async () => {
  await interrupted('meshrepair', ['soup.stl', 'out.stl', '--progress-fd', '3'], ['ignore', 'ignore', 'ignore', 'pipe'], told);
  // One that waits for its input.
  await interrupted('meshcheck', ['-', '--progress-fd', '3'], ['pipe', 'ignore', 'ignore', 'pipe'], told);
});

test('limits end a program with 4', () => {
  writeSoup(path.join(place, 'soup.stl'));
  for (const limit of [['--time-limit', '0.5'], ['--max-memory', '60M']]) {
    const words = ['soup.stl', 'none.stl', ...limit];
    const {status, stderr} = spawnSync(path.join(bin, 'meshrepair'), words, {cwd: place, encoding: 'utf8'});
    assert.equal(status, 4, stderr);
    assert.match(stderr, /^meshrepair: (time|memory) limit of [^\n]* reached [^\n]*\n$/);
    assert.equal(existsSync(path.join(place, 'none.stl')), false);
  }
});
