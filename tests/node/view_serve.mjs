// SPDX-License-Identifier: MIT
// Uses the page of meshrepair --serve in a browser, as somebody who has a broken mesh does.
//
// Usage: node view_serve.mjs PROGRAMS MESHES [SCREENSHOT]
//
// Prints a line for each fault. Exit code 0: there is none, 1: some, 77: there is no playwright (scripts/setup.sh all installs it) or
// no Chromium.

import {spawn, spawnSync} from 'node:child_process';
import {readdirSync, readFileSync, writeFileSync} from 'node:fs';
import path from 'node:path';

import {about, expect, withBrowser} from './pages.mjs';

const MESHES = ['broken_torus_box.stl', 'broken_spheres.obj', 'open_bowl.ply', 'overlapping_spheres.off', 'cube.stl'];

const [programs, meshes, screenshot] = process.argv.slice(2).map((name) => path.resolve(name));
let folder = ''; // empty at first

// The address that it prints, and how to end it.
function served() {
  const server = spawn(path.join(programs, 'meshrepair'), ['--serve', '--no-browser'], {stdio: ['ignore', 'pipe', 'ignore'],
    env: {...process.env, TMPDIR: folder}});
  return new Promise((done, failed) => {
    let said = '';
    server.stdout.on('data', (data) => {
      said += data;
      if (said.includes('\n')) done({server, address: said.trim()});
    });
    server.on('error', failed);
  });
}

async function ended(server) {
  const end = new Promise((done) => server.on('exit', done));
  server.kill('SIGINT');
  expect(await end === 0, 'does not end with 0 at Ctrl-C');
  expect(spawnSync('ls', [folder]).stdout.toString().includes('meshrepair-serve') === false, 'leaves its folder behind');
}

// What the program makes of it by itself.
function repaired(mesh, format) {
  const out = path.join(folder, `out.${format}`);
  spawnSync(path.join(programs, 'meshrepair'), ['-q', mesh, out]);
  return readFileSync(out);
}

async function opened(browser, address, options = {}) {
  const page = await browser.newPage({viewport: {width: 1280, height: 800}, ...options});
  page.on('console', (message) => expect(message.type() !== 'error', `console: ${message.text()}`));
  page.on('pageerror', (error) => expect(false, `error: ${error.message}`));
  page.on('request', (request) => expect(new URL(request.url()).host === new URL(address).host, `asks for ${request.url()}`));
  await page.goto(address);
  return page;
}

async function checked(page, file) {
  await page.setInputFiles('#file', file);
  await page.waitForSelector('body[data-ended=check]', {timeout: 120000});
  return page.textContent('#verdict');
}

async function downloaded(page) {
  await page.click('#repair');
  await page.waitForSelector('body[data-ended=repair]', {timeout: 120000});
  const waits = page.waitForEvent('download');
  await page.click('#result');
  const download = await waits;
  return {name: download.suggestedFilename(), bytes: readFileSync(await download.path()), verdict: await page.textContent('#verdict')};
}

async function repairAll(browser, address) {
  const page = await opened(browser, address);
  for (const name of MESHES) {
    const file = path.join(meshes, name);
    const verdict = await checked(page, file);
    expect(/not a valid/.test(verdict) === (name !== 'cube.stl'), `${name}: ${verdict}`);
    const format = name.split('.').pop();
    expect(await page.inputValue('#format') === format, `${name}: offers ${await page.inputValue('#format')}`);
    const {name: called, bytes, verdict: then} = await downloaded(page);
    expect(called === name.replace('.', '_repaired.'), `${name}: is called ${called}`);
    expect(then === 'Repaired and certified.', `${name}: ${then}`);
    expect(bytes.equals(repaired(file, format)), `${name}: another mesh than without the page`);
  }
  await lookAtThePage(page);
  await page.close();
}

async function lookAtThePage(page) {
  await checked(page, path.join(meshes, MESHES[0]));
  await downloaded(page);
  const frame = page.frameLocator('#page');
  await frame.locator('#page[data-ready]').waitFor({timeout: 120000});
  const counts = await frame.locator('[data-count^="input:open_edges"]').textContent();
  expect(counts === '23', `the page in the frame says ${counts} open edges`);
  if (screenshot) await page.screenshot({path: screenshot});
}

// As the program opens it itself: by a file that forwards, so that the address is in no list of processes.
async function forwarded(browser, address) {
  const file = path.join(folder, 'open.html');
  writeFileSync(file, `<!doctype html><meta http-equiv="refresh" content="0; url=${address}">\n`);
  const page = await browser.newPage();
  await page.goto(`file://${file}`);
  await page.waitForSelector('#choose');
  expect(/is a valid solid/.test(await checked(page, path.join(meshes, 'cube.stl'))), 'does not work when it is forwarded to');
  await page.close();
}

async function failClearly(browser, address) {
  const page = await opened(browser, address);
  for (const [name, data, what] of [['empty.stl', 'solid x\n', /holds no triangles/], ['bad.obj', 'v 1 2\n', /./]]) {
    const file = path.join(folder, name);
    writeFileSync(file, data);
    expect(what.test(await checked(page, file)), `${name}: ${await page.textContent('#verdict')}`);
    expect(!(await page.textContent('#verdict')).includes(folder), `${name}: says where it lies`);
    expect(await page.isHidden('#result'), `${name}: has a result`);
  }
  await page.close();
}

const kept = () => readdirSync(folder, {recursive: true}).filter((name) => /\bin$/.test(name)).length;

async function nothingIsKept(what) {
  for (let i = 0; i < 100 && kept() > 0; ++i) await new Promise((done) => setTimeout(done, 100));
  expect(kept() === 0, `${what} leaves ${kept()} meshes`);
}

// Nobody could end the work on a mesh of a page that is gone.
async function leave(browser, address) {
  await nothingIsKept('a page that was closed');
  const page = await opened(browser, address);
  await checked(page, path.join(meshes, MESHES[1]));
  expect(kept() === 1, 'the mesh of a page is not kept');
  await page.click('#repair');
  await page.reload();
  await nothingIsKept('a page that is loaded again');
  await checked(page, path.join(meshes, MESHES[0]));
  await page.close();
  await nothingIsKept('a page that is closed');
}

// They make the browser itself print errors.
async function failOnPurpose(browser, address) {
  const page = await browser.newPage();
  await page.goto(address);
  const file = path.join(folder, 'notes.txt');
  writeFileSync(file, 'text');
  await page.setInputFiles('#file', file);
  await page.waitForFunction(() => /not that of a mesh/.test(document.getElementById('verdict').textContent));
  await page.goto('about:blank');
  await page.goto(address.split('#')[0]);
  expect(/lacks its token/.test(await page.textContent('#verdict')), 'says nothing of a missing token');
  await page.close();
}

// Keys still go to a frame for a moment after the focus has left it: pressed until work has begun.
async function pressEnter(page, button) {
  for (let i = 0; i < 100; ++i) {
    await page.focus(button);
    await page.keyboard.press('Enter');
    const began = await page.evaluate((id) => document.querySelector(id).disabled || document.body.dataset.ended === 'repair', button);
    if (began) return;
    await page.waitForTimeout(100);
  }
}

async function useKeysAndAPhone(browser, address) {
  const page = await opened(browser, address, {viewport: {width: 390, height: 800}, hasTouch: true, isMobile: true});
  await checked(page, path.join(meshes, 'cube.stl'));
  expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'wider than a phone');
  const reached = new Set();
  for (let i = 0; i < 12; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => document.activeElement.id));
  }
  for (const id of ['choose', 'for', 'inside', 'seal', 'thicken', 'format', 'repair']) expect(reached.has(id), `Tab does not reach ${id}`);
  await page.selectOption('#for', 'print');
  await pressEnter(page, '#repair');
  await page.waitForSelector('body[data-ended=repair]', {timeout: 120000});
  await page.close();
}

await withBrowser(async ({browser, folder: empty}) => {
  folder = empty;
  about('the page of --serve');
  const {server, address} = await served();
  await repairAll(browser, address);
  await forwarded(browser, address);
  await failClearly(browser, address);
  await failOnPurpose(browser, address);
  await useKeysAndAPhone(browser, address);
  await leave(browser, address);
  await ended(server);
});
