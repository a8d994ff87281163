// SPDX-License-Identifier: MIT
// Opens the gallery of repair_folder.py --html in a browser: it shows what the summary says, and stays quick with 10,000 rows.
//
// Usage: node view_gallery.mjs MESHREPAIR MESHES
//
// Prints a line for each fault, and how long 10,000 rows take. Exit code 0: there is no fault, 1: some, 77: there is no playwright
// (scripts/setup.sh all installs it) or no Chromium.

import {spawnSync} from 'node:child_process';
import {copyFileSync, mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

import {about, expect, withBrowser} from './pages.mjs';

const SCRIPT = fileURLToPath(new URL('../../scripts/repair_folder.py', import.meta.url));
const MESHES = ['cube.stl', 'open_bowl.ply', 'broken_torus_box.stl', 'overlapping_spheres.off', 'hollow_sphere.obj'];
const MANY = 10000;

const [meshrepair, meshes] = process.argv.slice(2).map((name) => path.resolve(name));
let folder = ''; // empty at first
let out = '';

function repair() {
  const source = path.join(folder, 'in');
  mkdirSync(path.join(source, 'sub'), {recursive: true});
  for (const name of MESHES) copyFileSync(path.join(meshes, name), path.join(source, name));
  writeFileSync(path.join(source, 'sub/no mesh #1 <b>.stl'), 'solid nothing\n');
  spawnSync('python3', [SCRIPT, '-q', '--html', '--meshrepair', meshrepair, source, out]);
  return JSON.parse(readFileSync(path.join(out, 'summary.json'), 'utf8')).files;
}

const address = (name) => `file://${encodeURI(path.join(out, name))}`;

async function opened(browser, name, options = {}) {
  const page = await browser.newPage({viewport: {width: 1280, height: 800}, ...options});
  page.on('console', (message) => expect(message.type() !== 'error', `console: ${message.text()}`));
  page.on('pageerror', (error) => expect(false, `error: ${error.message}`));
  page.on('request', (request) => expect(request.url().startsWith(`file://${encodeURI(out)}/`), `asks for ${request.url()}`));
  await page.goto(address(name));
  await page.waitForSelector('html[data-ready]');
  return page;
}

const names = (page) => page.$$eval('tr.mesh th .clip', (cells) => cells.map((cell) => cell.firstChild.textContent));

async function compareRows(page, files) {
  expect(JSON.stringify(await names(page)) === JSON.stringify(files.map((file) => file.path)), `rows: ${await names(page)}`);
  for (const [i, file] of files.entries()) {
    const text = await page.textContent(`tr.mesh >> nth=${i}`);
    const triangles = file.triangles_out === null ? '' : file.triangles_out.toLocaleString('en-US');
    expect(text.includes(triangles), `${file.path}: ${text}`);
    expect(text.includes('certified') === (file.exit_code === 0), `${file.path}: verdict in ${text}`);
  }
  const drawn = () => [...document.images].length > 0 && [...document.images].every((image) => image.complete && image.naturalWidth > 0);
  await page.waitForFunction(drawn, null, {timeout: 60000}).catch(() => expect(false, 'pictures are missing'));
}

async function sortAndFilter(page, files) {
  await page.click('th.size button');
  const most = files.reduce((a, b) => (b.triangles_out > a.triangles_out ? b : a));
  expect((await names(page))[0] === most.path, `largest first: ${await names(page)}`);
  expect(await page.getAttribute('th.size', 'aria-sort') === 'descending', 'does not say how it is sorted');
  await page.fill('#name', 'BOWL');
  expect(JSON.stringify(await names(page)) === '["open_bowl.ply"]', `named bowl: ${await names(page)}`);
  expect(await page.textContent('#status') === `1 of ${files.length} meshes`, 'does not count what is shown');
  await page.click('#all');
  await page.waitForFunction((count) => document.querySelectorAll('tr.mesh').length === count, files.length);
  await page.click('[data-verdict="repaired and certified"]');
  expect(JSON.stringify(await names(page)) === JSON.stringify(files.filter((file) => file.exit_code !== 0).map((file) => file.path)),
      `without the certified: ${await names(page)}`);
  await page.click('[data-verdict="repaired and certified"]');
  await page.fill('#triangles', '100');
  const large = files.filter((file) => (file.triangles_out ?? file.triangles_in) >= 100).length;
  expect((await names(page)).length === large, `of 100 triangles: ${await names(page)}`);
}

async function openAPage(page) {
  const before = await names(page);
  await page.click('tr.mesh th a >> text=open_bowl.ply');
  await page.waitForSelector('#page[data-ready]', {timeout: 120000});
  expect((await page.textContent('h1')).includes('open_bowl.ply'), 'the page is of another mesh');
  await page.goBack();
  await page.waitForSelector('html[data-ready]');
  expect(JSON.stringify(await names(page)) === JSON.stringify(before), `after coming back: ${await names(page)}`);
}

async function useKeys(browser) {
  const page = await opened(browser, 'index.html');
  const reached = [];
  for (let i = 0; i < 40; ++i) {
    await page.keyboard.press('Tab');
    reached.push(await page.evaluate(() => document.activeElement.textContent.trim() || document.activeElement.id));
  }
  for (const name of ['name', 'triangles', 'Triangles', 'cube.stl', 'result']) expect(reached.includes(name), `Tab does not reach ${name}`);
  await page.focus('th.verdict button');
  await page.keyboard.press('Enter');
  expect(await page.getAttribute('th.verdict', 'aria-sort') === 'ascending', 'Enter does not sort');
  await page.close();
}

async function onAPhone(browser) {
  const page = await opened(browser, 'index.html', {viewport: {width: 390, height: 800}, hasTouch: true, isMobile: true});
  expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'wider than a phone');
  const broad = await page.$$eval('tr.mesh th', (cells) => cells.every((cell) => cell.getBoundingClientRect().width > 150));
  expect(broad, 'names are too narrow on a phone');
  await page.close();
}

// The same page with its rows repeated.
function writeMany() {
  const page = readFileSync(path.join(out, 'index.html'), 'utf8');
  const [, text] = page.match(/id="facts">(.*?)<\/script>/s);
  const facts = JSON.parse(text);
  const rows = Array.from({length: MANY}, (_, i) => {
    const row = [...facts.rows[i % facts.rows.length]];
    row[facts.columns.indexOf('url')] ??= row[0];
    return [`${String(i).padStart(5, '0')} ${row[0]}`, ...row.slice(1)];
  });
  const many = JSON.stringify({...facts, rows}).replace(/[<>&]/g, (c) => `\\u00${c.charCodeAt(0).toString(16)}`);
  writeFileSync(path.join(out, 'many.html'), page.replace(text, () => many));
}

async function showMany(browser) {
  writeMany();
  const begin = Date.now();
  const page = await opened(browser, 'many.html');
  console.log(`${MANY} rows: ready after ${Date.now() - begin} ms`);
  const count = () => page.$$eval('tr.mesh', (rows) => rows.length);
  expect(await count() < 60, `${await count()} rows in the document`);
  const slowest = await page.evaluate(async () => {
    let longest = 0;
    let last = performance.now();
    for (let i = 1; i <= 100; ++i) {
      scrollTo(0, document.documentElement.scrollHeight * i / 100);
      await new Promise((done) => requestAnimationFrame(done));
      longest = Math.max(longest, performance.now() - last);
      last = performance.now();
    }
    return longest;
  });
  console.log(`${MANY} rows: the slowest of 100 steps of scrolling takes ${slowest.toFixed(0)} ms`);
  await page.waitForFunction((name) => [...document.querySelectorAll('tr.mesh th')].some((cell) => cell.textContent.startsWith(name)),
      String(MANY - 1).padStart(5, '0'), {timeout: 10000}).catch(() => expect(false, 'the last row does not come in sight'));
  expect(await count() < 60, `${await count()} rows in the document at the end`);
  const sorting = await page.evaluate(() => {
    const start = performance.now();
    document.querySelector('th.size button').click();
    return performance.now() - start;
  });
  console.log(`${MANY} rows: sorted in ${sorting.toFixed(0)} ms`);
  await page.close();
}

await withBrowser(async ({browser, folder: empty}) => {
  folder = empty;
  out = path.join(folder, 'out');
  about('the gallery');
  const files = repair();
  const page = await opened(browser, 'index.html');
  await compareRows(page, files);
  await sortAndFilter(page, files);
  await openAPage(page);
  await page.close();
  await useKeys(browser);
  await onAPhone(browser);
  await showMany(browser);
});
