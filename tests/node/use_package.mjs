// SPDX-License-Identifier: MIT
// Uses the package of npm in node as its callers do.
//
// Usage: node use_package.mjs PACKAGE MESHES
//
// PACKAGE is the folder of the package, as build/wasm/package. Exit code 77: there is none.

import assert from 'node:assert/strict';
import {existsSync, readFileSync} from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import {pathToFileURL} from 'node:url';

const [folder, meshes] = process.argv.slice(2).map((name) => path.resolve(name));
if (!existsSync(path.join(folder, 'meshrepair.wasm'))) {
  console.log('there is no package: scripts/make_wasm.sh makes it');
  process.exit(77);
}
const {repair, check, boolean, read, write, formats, MeshRepairError} = await import(pathToFileURL(path.join(folder, 'node.js')));

const bytesOf = (name) => readFileSync(path.join(meshes, name));

// From 0 to 1, or moved by `x`.
function cube(x = 0, Numbers = Float64Array) {
  const vertices = Numbers.from([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1].map((value, i) => value + (i % 3 === 0 ? x : 0)));
  const faces = Uint32Array.from(
      [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7]);
  return {vertices, faces};
}

function volumeOf({vertices, faces}) {
  let six = 0;
  for (let i = 0; i < faces.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => vertices.subarray(3 * faces[i + k], 3 * faces[i + k] + 3));
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

async function fails(call, code, message) {
  await assert.rejects(call, (error) => {
    assert.ok(error instanceof MeshRepairError, String(error));
    assert.equal(error.code, code);
    assert.match(error.message, message);
    return true;
  });
}

test('a cube with a hole becomes a cube', async () => {
  const {vertices, faces} = cube();
  const open = {vertices, faces: faces.slice(3)};
  assert.equal((await check(open)).valid, false);
  const made = await repair(open);
  assert.equal(made.certified, true);
  assert.equal(volumeOf(made), 1);
  assert.equal(made.sources.length, made.faces.length / 3);
  assert.ok(made.vertices instanceof Float64Array);
  assert.equal((await check(made)).valid, true);
  assert.equal((await made.bytes('stl')).length, 84 + 50 * made.faces.length / 3);
});

test('single precision stays single precision', async () => {
  const made = await repair(cube(0.1, Float32Array), {always: true});
  assert.ok(made.vertices instanceof Float32Array);
});

test('a check marks triangles', async () => {
  const {vertices, faces} = cube();
  const doubled = {vertices, faces: Uint32Array.from([...faces, ...faces.slice(0, 3)])};
  const {valid, marks, defects, report} = await check(doubled);
  assert.equal(valid, false);
  assert.equal(marks[12] >> defects.indexOf('duplicate_triangles') & 1, 1);
  assert.equal(report.check.triangles ?? report.check.defects.duplicate_triangles.count > 0, report.check.triangles ?? true);
});

test('solids are combined', async () => {
  for (const [op, volume] of [['union', 1.5], ['intersection', 0.5], ['difference', 0.5], ['xor', 1]]) {
    assert.equal(volumeOf(await boolean([cube(), cube(0.5)], op)), volume, op);
  }
  const made = await boolean([cube(), cube(0.5)], 'union', {to: 'off'});
  assert.match(new TextDecoder().decode(await made.bytes()), /^OFF\n/);
});

test('files of all formats are written and read', async () => {
  for (const format of formats) {
    const {bytes, files} = await write(cube(), {to: format});
    const back = await read(bytes, {from: format, files});
    assert.equal(volumeOf(back), 1, format);
  }
});

test('attributes go out and come in', async () => {
  const mesh = cube();
  mesh.attributes = [{name: 'texture', components: 2, values: Float64Array.from([0.25, 0.5]), corners: new Uint32Array(36)}];
  const {bytes, files} = await write(mesh, {to: 'obj'});
  const [texture] = (await read(bytes, {from: 'obj', files})).attributes;
  assert.equal(texture.name, 'texture');
  assert.deepEqual([...texture.values], [0.25, 0.5]);
});

test('a file is repaired to a file, with a page', async () => {
  const made = await repair(bytesOf('broken_torus_box.stl'), {from: 'broken_torus_box.stl', to: '3mf', for: 'print', html: true});
  assert.equal(made.certified, true);
  assert.equal(made.report.purpose.name ?? made.report.purpose, 'print');
  assert.equal(new TextDecoder('latin1').decode((await made.bytes()).slice(0, 2)), 'PK');
  assert.match(new TextDecoder().decode(made.html), /^<!doctype html>/i);
});

test('options are those of the program, in any spelling', async () => {
  for (const options of [{maxHole: 0.5}, {max_hole: 0.5}, {'max-hole': '0.5'}, {always: true}, {always: false}]) {
    assert.equal((await repair(cube(), options)).certified, true);
  }
  await fails(repair(cube(), {nonsense: 1}), 'usage', /nonsense: there is no such option/);
  await fails(repair(cube(), {inside: 'nonsense'}), 'usage', /inside/);
});

test('what makes no sense is refused', async () => {
  await fails(repair(new Uint8Array([1, 2, 3]), {from: 'x.stl'}), 'input', /x\.stl: /);
  await fails(repair(new Uint8Array()), 'input', /^mesh: /);
  await fails(repair('words'), 'usage', /neither bytes/);
  await fails(repair({vertices: new Float64Array(9), faces: Uint32Array.from([0, 1, 7])}), 'usage', /./);
  await fails(repair({vertices: new Float64Array(8), faces: new Uint32Array(3)}), 'usage', /vertices/);
  await fails(repair({vertices: new Float64Array(9), faces: Uint32Array.from([0, 1, 2])}), 'no_solid', /./);
  await fails(write(cube(), {to: 'docx'}), 'usage', /./);
});

test('names of files lead nowhere else', async () => {
  const made = await repair(bytesOf('cube.stl'), {from: '../../cube.stl', to: '../../../etc/out.stl'});
  assert.equal(made.report.output.path, 'out.stl');
  assert.equal(made.report.input.path, 'cube.stl');
});

test('progress names stages, and shares do not fall', async () => {
  const told = [];
  await repair(bytesOf('broken_torus_box.stl'), {from: 'stl', progress: (each) => told.push(each)});
  assert.ok(told.some(({stage}) => stage === 'read'));
  for (let i = 1; i < told.length; ++i) {
    if (told[i].stage === told[i - 1].stage) assert.ok(told[i].share >= told[i - 1].share);
  }
});

test('an aborted call ends, and the next one works', async () => {
  const controller = new AbortController();
  const running = repair(bytesOf('broken_spheres.obj'), {from: 'obj', always: true, signal: controller.signal, progress: () => controller.abort()});
  await assert.rejects(running, {name: 'AbortError'});
  assert.equal((await check(cube())).valid, true);
  await assert.rejects(repair(cube(), {signal: AbortSignal.abort()}), {name: 'AbortError'});
});

test('calls at the same time do not meet', async () => {
  const all = await Promise.all([0.25, 0.5, 0.75].map((x) => boolean([cube(), cube(x)], 'union')));
  assert.deepEqual(all.map(volumeOf), [1.25, 1.5, 1.75]);
});

test('the same in, the same out', async () => {
  const [a, b] = [await repair(bytesOf('broken_spheres.obj'), {from: 'obj'}), await repair(bytesOf('broken_spheres.obj'), {from: 'obj'})];
  assert.deepEqual(await a.bytes(), await b.bytes());
});
