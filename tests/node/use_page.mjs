// SPDX-License-Identifier: MIT
// Opens the page that repairs in a browser, without a network once it is loaded: what it gives back has the bytes of the program.
//
// Usage: node use_page.mjs PAGE PROGRAM MESH...
//
// PAGE is the folder of the page, as build/wasm/page; the last MESH is a small one. Prints a line for each fault, and how long each mesh took. Exit code 0: there is no
// fault, 1: some, 77: there is no page, no playwright (scripts/setup.sh all installs it) or no Chromium.

import {spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import path from 'node:path';

const CHROMIUM = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
const DRAWING = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];
const TYPES = {html: 'text/html', js: 'text/javascript', css: 'text/css', svg: 'image/svg+xml', wasm: 'application/wasm'};
const PATIENCE = 1500000;  // milliseconds

const [site, program, ...meshes] = process.argv.slice(2).map((name) => path.resolve(name));
const folder = mkdtempSync(path.join(tmpdir(), 'use_page_'));
let faults = 0;
let subject = '';

function expect(holds, what) {
  if (holds) return;
  console.log(`${subject}: ${what}`);
  ++faults;
}

function serve() {
  const server = createServer((request, answer) => {
    const name = path.join(site, new URL(request.url, 'http://localhost').pathname.replace(/\/$/, '/index.html'));
    if (!existsSync(name)) return answer.writeHead(404).end();
    answer.writeHead(200, {'Content-Type': TYPES[name.split('.').at(-1)] ?? 'text/plain'}).end(readFileSync(name));
  });
  return new Promise((done) => server.listen(0, '127.0.0.1', () => done(server)));
}

async function opened(browser, url, options = {}) {
  const page = await browser.newPage({viewport: {width: 1280, height: 800}, reducedMotion: 'reduce', ...options});
  page.setDefaultTimeout(PATIENCE);
  page.on('console', (message) => expect(message.type() !== 'error', `console: ${message.text()}`));
  page.on('pageerror', (error) => expect(false, `error: ${error.message}`));
  page.on('request', (request) => expect(/^(blob:)?http:\/\/127\.0\.0\.1[:/]/.test(request.url()), `asks for ${request.url()}`));
  await page.goto(url);
  await page.waitForSelector('body[data-state=empty]');
  return page;
}

function wanted(mesh, format) {
  const target = path.join(folder, `wanted.${format}`);
  rmSync(target, {force: true});
  const {status} = spawnSync(program, ['-q', '--threads', '1', path.basename(mesh), target], {cwd: path.dirname(mesh)});
  return {status, bytes: existsSync(target) ? readFileSync(target) : null};
}

// Until what `start` begins is done.
async function settled(page, start) {
  const before = await page.evaluate(() => Number(document.body.dataset.done ?? 0));
  await start();
  await page.waitForFunction((count) => Number(document.body.dataset.done) > count, before, {timeout: PATIENCE});
}

async function download(page) {
  const [file] = await Promise.all([page.waitForEvent('download'), page.click('#downloads a')]);
  return {name: file.suggestedFilename(), bytes: readFileSync(await file.path())};
}

async function isDrawn(page) {
  await page.waitForSelector('#viewer', {state: 'visible'});
  await page.frameLocator('#viewer').locator('#page[data-ready]').waitFor();
  return page.frameLocator('#viewer').locator('#verdict').textContent();
}

async function repairOne(page, mesh, format) {
  subject = path.basename(mesh);
  let begin = performance.now();
  await settled(page, () => page.setInputFiles('#file', mesh));
  const checked = (performance.now() - begin) / 1000;
  expect((await isDrawn(page)).length > 0, 'the check shows nothing');
  await page.selectOption('select[name=to]', format);
  begin = performance.now();
  await settled(page, () => page.click('#repair'));
  const repaired = (performance.now() - begin) / 1000;
  const said = await page.textContent('#verdict');
  const expected = wanted(mesh, format);
  expect((expected.status === 0) === /certified/.test(said), `says "${said}", the program ends with ${expected.status}`);
  await isDrawn(page);
  const got = await download(page);
  expect(expected.bytes?.equals(got.bytes), `${got.name} has other bytes than the program's`);
  console.log(`${subject}: ${got.bytes.length} bytes as the program's, checked in ${checked.toFixed(1)} s, repaired in ${repaired.toFixed(1)} s`);
}

async function cancelOne(page, mesh) {
  subject = `cancelling ${path.basename(mesh)}`;
  await settled(page, () => page.setInputFiles('#file', mesh));
  await settled(page, async () => {
    await page.click('#repair');
    await page.keyboard.press('Escape');
  });
  expect(/Cancelled|certified/.test(await page.textContent('#verdict')), `says "${await page.textContent('#verdict')}"`);
}

async function refuse(page) {
  subject = 'a file that is no mesh';
  const letter = {name: 'letter.txt', mimeType: 'text/plain', buffer: Buffer.from('Dear reader, this is no mesh.\n')};
  await settled(page, () => page.setInputFiles('#file', letter));
  expect(/letter\.txt: /.test(await page.textContent('#verdict')), `says "${await page.textContent('#verdict')}"`);
}

async function dropOne(page, mesh) {
  subject = 'dropping';
  const transfer = await page.evaluateHandle(([name, bytes]) => {
    const all = new DataTransfer();
    all.items.add(new File([Uint8Array.from(bytes)], name));
    return all;
  }, [path.basename(mesh), [...readFileSync(mesh)]]);
  await settled(page, () => page.dispatchEvent('#drop', 'drop', {dataTransfer: transfer}));
  expect(/solid/.test(await page.textContent('#verdict')), 'dropping a file does nothing');
}

async function useKeys(page) {
  subject = 'keys';
  await page.evaluate(() => document.activeElement?.blur());
  const reached = new Set();
  for (let i = 0; i < 80; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => document.activeElement?.id || document.activeElement?.name || document.activeElement?.tagName));
  }
  for (const name of ['drop', 'for', 'to', 'repair']) expect(reached.has(name), `Tab does not reach ${name}, only ${[...reached]}`);
  const unnamed = await page.$$eval('button, select, iframe, progress', (all) => all.filter((one) =>
      !(one.textContent.trim() || one.title || one.labels?.length)).map((one) => one.outerHTML));
  expect(unnamed.length === 0, `without a name: ${unnamed}`);
}

async function onAPhone(browser, url, mesh) {
  subject = 'a phone';
  const page = await opened(browser, url, {viewport: {width: 390, height: 800}, hasTouch: true, isMobile: true, colorScheme: 'dark'});
  await settled(page, () => page.setInputFiles('#file', mesh));
  expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'wider than a phone');
  const low = await page.$$eval('button, select', (all) => all.filter((one) => one.offsetHeight > 0 && one.offsetHeight < 40).length);
  expect(low === 0, `${low} too small for a finger`);
  await page.close();
}

async function main() {
  if (!existsSync(path.join(site, 'index.html'))) {
    console.log('there is no page: scripts/make_wasm.sh makes it');
    return 77;
  }
  let playwright;
  try {
    playwright = await import('playwright-core');
  } catch (error) {
    console.log(`playwright is not installed: ${error.code}`);
    return 77;
  }
  if (CHROMIUM === undefined) {
    console.log('there is no Chromium');
    return 77;
  }
  const server = await serve();
  const url = `http://127.0.0.1:${server.address().port}/`;
  const launched = await playwright.chromium.launch({executablePath: CHROMIUM, args: DRAWING});
  const browser = await launched.newContext();
  const page = await opened(browser, url);
  await page.evaluate(() => navigator.serviceWorker.ready);
  // From here on nobody answers.
  server.close();
  server.closeAllConnections();
  subject = 'without a network';
  await page.reload();
  await page.waitForSelector('body[data-state=empty]');
  for (const mesh of meshes) await repairOne(page, mesh, 'stl');
  await cancelOne(page, meshes[0]);
  await refuse(page);
  await dropOne(page, meshes.at(-1));
  await useKeys(page);
  await page.close();
  await onAPhone(browser, url, meshes.at(-1));
  await launched.close();
  return faults === 0 ? 0 : 1;
}

const code = await main().finally(() => rmSync(folder, {recursive: true, force: true}));
process.exit(code);
