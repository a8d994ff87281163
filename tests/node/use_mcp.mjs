// SPDX-License-Identifier: MIT
// Uses `meshrepair mcp` of the package of npm as assistants do: by the client of the protocol's own SDK, and by lines of any kind.
//
// Usage: node use_mcp.mjs PACKAGE PROGRAMS MESHES
//
// PACKAGE is the folder of the package, as build/wasm/package, PROGRAMS that of the native programs. Exit code 77: there is no package, no
// npm, or no SDK (npm ci in tests/node).

import assert from 'node:assert/strict';
import {spawn, spawnSync} from 'node:child_process';
import {cpSync, existsSync, mkdtempSync, mkdirSync, readFileSync, readdirSync, symlinkSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import {install, skip, writeSoup} from './npm_package.mjs';

const [folder, programs, meshes] = process.argv.slice(2).map((name) => path.resolve(name));
const absent = ({code}) => skip(`the SDK of the protocol is not installed: ${code}`);
const {Client} = await import('@modelcontextprotocol/sdk/client/index.js').catch(absent);
const {StdioClientTransport} = await import('@modelcontextprotocol/sdk/client/stdio.js').catch(absent);

const {place, bin} = install(folder);
const command = path.join(bin, 'meshrepair');

const SAMPLES = ['broken_torus_box.stl', 'cube.stl', 'overlapping_spheres.off'];

// A folder with some meshes, and what should not be reached beside it.
function newFolder() {
  const around = mkdtempSync(path.join(place, 'around-'));
  const home = path.join(around, 'home');
  mkdirSync(home);
  for (const name of SAMPLES) cpSync(path.join(meshes, name), path.join(home, name));
  cpSync(path.join(meshes, 'cube.stl'), path.join(around, 'secret.stl'));
  mkdirSync(path.join(around, 'home2'));
  cpSync(path.join(meshes, 'cube.stl'), path.join(around, 'home2/secret.stl'));
  return home;
}

// Of native programs where it is the server that is tried, not the programs: they are faster.
async function connected(t, words, env = {MESHREPAIR_PROGRAMS: programs}) {
  const client = new Client({name: 'use_mcp', version: '1'});
  await client.connect(new StdioClientTransport({command, args: ['mcp', ...words], env: {PATH: process.env.PATH, ...env}}));
  t.after(() => client.close());
  const call = (name, args, options) => client.callTool({name, arguments: args}, undefined, options);
  return {client, call};
}

const said = ({content}) => content[0].text;
const imageOf = ({content}) => Buffer.from(content.find(({type}) => type === 'image').data, 'base64');
const isPng = (bytes) => bytes.subarray(1, 4).toString() === 'PNG';

test('an assistant checks, repairs, compares, combines and looks', async (t) => {
  const home = newFolder();
  const {client, call} = await connected(t, [home], {});
  assert.match(client.getInstructions(), new RegExp(home));
  const {tools} = await client.listTools();
  assert.deepEqual(tools.map(({name}) => name), ['list', 'check', 'repair', 'boolean', 'distance', 'picture']);
  for (const {name, annotations, inputSchema} of tools) {
    assert.equal(annotations.readOnlyHint, !['repair', 'boolean'].includes(name));
    assert.equal(inputSchema.additionalProperties, false);
  }
  assert.equal((await call('list', {})).structuredContent.files.length, 3);

  const told = [];
  const checked = await call('check', {mesh: 'broken_torus_box.stl', places: 3}, {onprogress: (each) => told.push(each)});
  assert.equal(checked.isError, false);
  assert.match(said(checked), /^verdict {3}NOT A VALID SOLID: not closed/m);
  const {defects, valid_solid: isValid} = checked.structuredContent.report.check;
  assert.equal(isValid, false);
  assert.equal(defects.open_edges.count, 23);
  assert.equal(defects.open_edges.first.length, 3);
  assert.ok(checked.structuredContent.left_out.includes('stages'));
  assert.deepEqual(JSON.parse(checked.content[1].text).report, checked.structuredContent.report);
  assert.match(told[0].message, /^[a-z]+ \d+ %$/);

  const repaired = await call('repair', {mesh: 'broken_torus_box.stl', output: 'whole.stl', for: 'print', triangles: '50%', picture: true});
  assert.equal(repaired.isError, false, said(repaired));
  assert.match(said(repaired), /^checked {3}closed, manifold, oriented/m);
  assert.equal(repaired.structuredContent.report.purpose.name, 'print');
  assert.ok(isPng(imageOf(repaired)));
  const native = path.join(home, '../native.stl');
  const words = [path.join(home, 'broken_torus_box.stl'), native, '--for', 'print', '--triangles', '50%'];
  assert.equal(spawnSync(path.join(programs, 'meshrepair'), words).status, 0);
  assert.ok(readFileSync(path.join(home, 'whole.stl')).equals(readFileSync(native)));

  assert.equal((await call('check', {mesh: path.join(home, 'whole.stl')})).structuredContent.report.check.valid_solid, true);
  const apart = await call('distance', {a: 'broken_torus_box.stl', b: 'whole.stl'});
  assert.match(said(apart), /^Hausdorff distance [\d.]+/m);
  const part = await call('boolean', {operation: 'difference', meshes: ['whole.stl', 'cube.stl'], output: 'part.3mf'});
  assert.equal(part.isError, false, said(part));
  assert.ok(existsSync(path.join(home, 'part.3mf')));
  assert.ok(isPng(imageOf(await call('picture', {mesh: 'part.3mf', view: '-30,20.5', colours: 'defects'}))));
});

test('nothing outside the folders is read or written', async (t) => {
  const home = newFolder();
  const around = path.dirname(home);
  symlinkSync('../secret.stl', path.join(home, 'link.stl'));
  symlinkSync('..', path.join(home, 'way'));
  symlinkSync('../made.mtl', path.join(home, 'out.mtl'));
  symlinkSync('../made.stl', path.join(home, 'out.stl'));
  symlinkSync('/dev/zero', path.join(home, 'zero.stl'));
  assert.equal(spawnSync('mkfifo', [path.join(home, 'fifo.stl')]).status, 0);
  const {call} = await connected(t, [home]);
  const before = readdirSync(around, {recursive: true}).sort();
  const inputs = [
    ['../secret.stl', /outside/], [path.join(around, 'secret.stl'), /outside/], ['../home2/secret.stl', /outside/],
    ['link.stl', /outside/], ['way/secret.stl', /outside/], ['zero.stl', /outside/], ['/dev/zero', /outside/], ['../none.stl', /outside/],
    ['cube.stl/../../secret.stl', /outside/], ['fifo.stl', /no regular file/], ['.', /no regular file/], ['none.stl', /no such file/],
  ];
  const output = 'new.stl';
  for (const [mesh, why] of inputs) {
    const calls = {
      check: {mesh}, picture: {mesh}, distance: {a: 'cube.stl', b: mesh}, repair: {mesh, output},
      boolean: {operation: 'xor', meshes: ['cube.stl', mesh], output},
    };
    for (const [name, args] of Object.entries(calls)) {
      const refused = await call(name, args);
      assert.equal(refused.isError, true);
      assert.match(said(refused), why);
      assert.ok(said(refused).startsWith(mesh) && !said(refused).includes('\n'), said(refused));
    }
  }
  const outputs = [
    ['../made.stl', /outside/], [path.join(around, 'made.stl'), /outside/], ['way/made.stl', /outside/], ['out.stl', /is a link/],
    ['out.obj', /out\.mtl: is a link/], ['none/out.stl', /no such folder/], ['.', /is a folder/], ['way', /is a link/],
    ['fifo.stl', /no regular file/], ['cube.stl/out.stl', /not in a folder/],
  ];
  for (const [target, why] of outputs) {
    const refused = await call('repair', {mesh: 'cube.stl', output: target, overwrite: true});
    assert.equal(refused.isError, true);
    assert.match(said(refused), why);
  }
  assert.match(said(await call('list', {folder: '..'})), /outside/);
  assert.deepEqual((await call('list', {})).structuredContent.files.map((file) => path.basename(file.path)), SAMPLES);
  assert.deepEqual(readdirSync(around, {recursive: true}).sort(), before);
});

test('a file is overwritten only where that is asked for', async (t) => {
  const home = newFolder();
  writeFileSync(path.join(home, 'new.mtl'), 'mine');
  const {call} = await connected(t, [home]);
  const before = readFileSync(path.join(home, 'cube.stl'));
  const refused = await call('repair', {mesh: 'broken_torus_box.stl', output: 'cube.stl'});
  assert.match(said(refused), /cube\.stl: exists; .*overwrite/);
  assert.match(said(await call('repair', {mesh: 'cube.stl', output: 'new.obj'})), /new\.mtl: exists/);
  assert.ok(readFileSync(path.join(home, 'cube.stl')).equals(before));
  assert.equal((await call('repair', {mesh: 'broken_torus_box.stl', output: 'cube.stl', overwrite: true})).isError, false);
  assert.ok(!readFileSync(path.join(home, 'cube.stl')).equals(before));
  const both = await Promise.all([1, 2].map(() => call('repair', {mesh: 'broken_torus_box.stl', output: 'same.stl'})));
  assert.deepEqual(both.map(({isError}) => isError).sort(), [false, true]);
});

test('only options of the schemas reach a program', async (t) => {
  const home = newFolder();
  for (const name of ['--version', '-', '-h.stl']) cpSync(path.join(home, 'cube.stl'), path.join(home, name));
  const {call} = await connected(t, [home]);
  for (const mesh of ['--version', '-', '-h.stl']) assert.match(said(await call('check', {mesh})), /verdict/);
  const wrong = [
    ['check', {}], ['check', {mesh: 7}], ['check', {mesh: ['cube.stl']}], ['check', {mesh: ''}], ['check', {mesh: 'a\0b'}],
    ['boolean', {operation: 'union', meshes: ['cube.stl'], output: 'a.stl'}], ['picture', {mesh: 'cube.stl', view: '1,2;3'}], ['none', {}],
    ...[{places: 1000}, {places: 1.5}, {report: '/tmp/r'}, {constructor: 1}].map((more) => ['check', {mesh: 'cube.stl', ...more}]),
    ...[{seal: '1 --report x'}, {seal: -1}, {keep: '--help'}, {for: 'love'}, {base: 'yes'}, {max_error: null}].map(
        (more) => ['repair', {mesh: 'cube.stl', output: 'a.stl', ...more}]),
  ];
  for (const [name, args] of wrong) await assert.rejects(call(name, args), {code: -32602}, `${name} ${JSON.stringify(args)}`);
  const set = {seal: '0.1%', thicken: 'none', keep: 2, max_error: 0.001, holes: 'flat', cavities: 'fill', inside: 'winding', base: false};
  const right = await call('repair', {mesh: 'cube.stl', output: 'a.stl', ...set});
  assert.equal(right.isError, false, said(right));
});

test('a mesh that fails is a result, with its line', async (t) => {
  const home = newFolder();
  writeFileSync(path.join(home, 'words.stl'), 'words');
  writeFileSync(path.join(home, 'triangle.obj'), 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n');
  const {call} = await connected(t, ['--max-file', '100K', home]);
  const cases = [
    ['words.stl', 'a.stl', /^meshrepair: [^\n]*words\.stl: [^\n]*\n\(an input cannot be read\)$/],
    ['triangle.obj', 'a.stl', /encloses nothing/], ['cube.stl', 'a.xyz', /no mesh format/],
    ['broken_torus_box.stl', 'a.stl', /116334 bytes; this server reads at most 102400/],
  ];
  for (const [mesh, output, why] of cases) {
    const failed = await call('repair', {mesh, output});
    assert.equal(failed.isError, true);
    assert.match(said(failed), why);
  }
  assert.equal(existsSync(path.join(home, 'a.stl')), false);
});

test('a cancelled call ends, and so does one that waits; the next one works', async (t) => {
  const home = newFolder();
  writeSoup(path.join(home, 'soup.stl'));
  const before = readdirSync(home);
  const {call} = await connected(t, ['--jobs', '1', home], {});
  const [first, second] = [new AbortController(), new AbortController()];
  let running;
  await new Promise((onprogress, fail) => {
    running = call('repair', {mesh: 'soup.stl', output: 'out.stl'}, {signal: first.signal, onprogress});
    running.catch(fail);
  });
  const waiting = call('check', {mesh: 'cube.stl'}, {signal: second.signal});
  second.abort();
  await assert.rejects(waiting);
  first.abort();
  await assert.rejects(running);
  assert.match(said(await call('check', {mesh: 'cube.stl'})), /verdict/);
  assert.deepEqual(readdirSync(home), before);
});

test('a limit of time ends a call', async (t) => {
  const home = newFolder();
  writeSoup(path.join(home, 'soup.stl'));
  const {call} = await connected(t, ['--time-limit', '0.5', home]);
  const ended = await call('repair', {mesh: 'soup.stl', output: 'out.stl'});
  assert.equal(ended.isError, true);
  assert.match(said(ended), /time limit of [^\n]* reached/);
  assert.equal(ended.structuredContent.report.exit_code, 4);
});

// A server that is sent lines, and its answers.
function raw(...words) {
  const child = spawn(command, ['mcp', ...words], {env: {...process.env, MESHREPAIR_PROGRAMS: programs}});
  let rest = '';
  const [answers, waiting] = [[], []];
  child.stdout.setEncoding('utf8');
  child.stdout.on('data', (text) => {
    const lines = (rest + text).split('\n');
    rest = lines.pop();
    answers.push(...lines.map((line) => JSON.parse(line)));
    while (waiting.length > 0 && answers.length > 0) waiting.shift()(answers.shift());
  });
  const isLine = (message) => typeof message === 'string' || Buffer.isBuffer(message);
  return {
    child,
    send: (message) => child.stdin.write(isLine(message) ? message : `${JSON.stringify({jsonrpc: '2.0', ...message})}\n`),
    next: () => (answers.length > 0 ? answers.shift() : new Promise((done) => waiting.push(done))),
    ended: new Promise((done) => child.on('exit', (code) => done(code))),
  };
}

const hello = (protocolVersion) =>
  ({id: 0, method: 'initialize', params: {protocolVersion, capabilities: {}, clientInfo: {name: 'raw', version: '1'}}});

test('lines of any kind are answered as the protocol says', async () => {
  const {child, send, next, ended} = raw(newFolder());
  const fails = async (line, code, id = null) => {
    send(line);
    const answer = await next();
    assert.equal(answer.error?.code, code, `${line}: ${JSON.stringify(answer)}`);
    assert.equal(answer.id, id);
  };
  await fails({id: 1, method: 'tools/list'}, -32600, 1);
  await fails('{"jsonrpc": "2.0", "id": 1, "meth\n', -32700);
  await fails(Buffer.from('"\xff"\n', 'latin1'), -32700);
  await fails(`"${'x'.repeat(5 << 20)}"\n`, -32700);
  await fails(`${'['.repeat(100000)}\n`, -32700);
  for (const line of ['7', 'null', '{}', '{"id": 1, "method": "ping"}', '[]', '{"jsonrpc": "2.0", "id": null, "method": "ping"}']) {
    await fails(`${line}\n`, -32600);
  }
  await fails({id: 2, method: 7}, -32600, 2);
  await fails({id: 2, method: 'initialize', params: []}, -32602, 2);
  await fails({id: 2, method: 'initialize', params: {}}, -32602, 2);
  send({id: 'ping', method: 'ping'});
  assert.deepEqual((await next()).result, {});
  send('\r\n\n');
  send(hello('1999-01-01'));
  assert.equal((await next()).result.protocolVersion, '2025-06-18');
  send({method: 'notifications/initialized'});
  send({method: 'notifications/unknown'});
  send({method: 'notifications/cancelled', params: {requestId: 'none'}});
  send({id: 9, result: {}});
  await fails(hello('2025-06-18'), -32600, 0);
  await fails({id: 3, method: 'resources/list'}, -32601, 3);
  await fails({id: 3, method: 'tools/call', params: 7}, -32602, 3);
  await fails('[{"jsonrpc": "2.0", "id": 1, "method": "ping"}]\n', -32600);
  child.stdin.end();
  assert.equal(await ended, 0);
});

test('older versions have what is theirs', async () => {
  const {child, send, next} = raw(newFolder());
  send(hello('2025-03-26'));
  assert.equal((await next()).result.protocolVersion, '2025-03-26');
  const requests = [{id: 1, method: 'ping'}, {method: 'notifications/initialized'}, {id: 2, method: 'none'}];
  send(`${JSON.stringify([...requests.map((each) => ({jsonrpc: '2.0', ...each})), 7])}\n`);
  assert.deepEqual((await next()).map(({id, error}) => [id, error?.code]), [[1, undefined], [2, -32601], [null, -32600]]);
  send({id: 3, method: 'tools/call', params: {name: 'check', arguments: {mesh: 'cube.stl'}}});
  const {result} = await next();
  assert.equal(result.structuredContent, undefined);
  assert.equal(JSON.parse(result.content[1].text).report.check.valid_solid, true);
  child.stdin.end();
});

test('the end of standard input, or a signal, ends the server and what it runs', async () => {
  const ends = [[(child) => child.stdin.end(), 0], [(child) => child.kill('SIGTERM'), 143], [(child) => child.kill('SIGINT'), 130]];
  for (const [end, code] of ends) {
    const home = newFolder();
    writeSoup(path.join(home, 'soup.stl'));
    const before = readdirSync(home);
    const {child, send, next, ended} = raw(home);
    send(hello('2025-06-18'));
    await next();
    const params = {name: 'repair', arguments: {mesh: 'soup.stl', output: 'out.stl'}, _meta: {progressToken: 'p'}};
    send({id: 1, method: 'tools/call', params});
    assert.equal((await next()).params.progressToken, 'p');
    end(child);
    assert.equal(await ended, code);
    assert.deepEqual(readdirSync(home), before);
  }
});

test('the command line is explained, and refused where it is wrong', () => {
  const run = (...words) => spawnSync(command, ['mcp', ...words], {encoding: 'utf8', input: ''});
  assert.match(run('--help').stdout, /^Usage: meshrepair mcp .*\n[^]*Examples:/);
  assert.equal(run('--help').status, 0);
  const home = newFolder();
  assert.equal(run(home).status, 0);
  const wrong = [
    [], ['/none'], [path.join(home, 'cube.stl')], ['--time-limit', 'x', home], ['--max-file', 'big', home], ['--jobs', '0', home],
    ['--max-memory', '-1', home], ['--none', home], ['out.stl'],
  ];
  for (const words of wrong) {
    const {status, stdout, stderr} = run(...words);
    assert.equal(status, 2, words.join(' '));
    assert.equal(stdout, '');
    assert.match(stderr, /^meshrepair mcp: [^\n]*\n$/);
  }
});
