// SPDX-License-Identifier: MIT
// What tests of pages in a browser share: pages are made and opened, looked at, and compared with the report.
import {spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';

const CHROMIUM = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
const DRAWING = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];
const SKIPPED = 77;

const faults = [];
let subject = '';

// What faults are said of from now on.
export function about(what) {
  subject = what;
}

export function expect(holds, what) {
  if (!holds) faults.push(`${subject}: ${what}`);
}

export async function launched(playwright, ...more) {
  return playwright.chromium.launch({executablePath: CHROMIUM, args: more.length > 0 ? ['--no-sandbox', ...more] : DRAWING});
}

// Runs `look` with a browser, playwright and an empty folder. Prints faults, and ends the process: 0: there are none, 1: some,
// 77: there is no playwright (scripts/setup.sh all installs it) or no Chromium.
export async function withBrowser(look) {
  let playwright;
  try {
    playwright = await import('playwright-core');
  } catch (error) {
    console.log(`playwright is not installed: ${error.code}`);
    process.exit(SKIPPED);
  }
  if (!CHROMIUM) {
    console.log('there is no Chromium');
    process.exit(SKIPPED);
  }
  const folder = mkdtempSync(path.join(tmpdir(), 'view_html_'));
  try {
    const browser = await launched(playwright);
    await look({browser, playwright, folder});
    await browser.close();
  } finally {
    rmSync(folder, {recursive: true});
  }
  for (const fault of faults) console.log(fault);
  process.exit(faults.length === 0 ? 0 : 1);
}

// The page and the report of a command.
export function made(program, folder, ...command) {
  const [page, report] = ['page.html', 'report.json'].map((name) => path.join(folder, name));
  const run = spawnSync(program, ['-q', ...command, '--html', page, '--report', report]);
  expect(existsSync(page), `no page; exit code ${run.status}: ${run.stderr}`);
  return {page, report: JSON.parse(readFileSync(report, 'utf8'))};
}

export function repaired(programs, folder, mesh, ...more) {
  return made(path.join(programs, 'meshrepair'), folder, mesh, path.join(folder, 'out.obj'), ...more);
}

// Errors on its console, and whatever it asks for, are faults.
export async function opened(browser, file, options = {}) {
  const page = await browser.newPage({viewport: {width: 1280, height: 800}, reducedMotion: 'reduce', ...options});
  page.on('console', (message) => expect(message.type() !== 'error', `console: ${message.text()}`));
  page.on('pageerror', (error) => expect(false, `error: ${error.message}`));
  page.on('request', (request) => expect(request.url() === `file://${encodeURI(file)}` || /^(blob|data):/.test(request.url()),
      `asks for ${request.url()}`));
  await page.goto(`file://${encodeURI(file)}`);
  await page.waitForSelector('#page[data-ready]', {timeout: 120000});
  return page;
}

// What the canvas shows once nothing moves, smaller.
export async function picture(page) {
  await page.waitForFunction(() => document.getElementById('canvas').dataset.drawn === 'yes', null, {timeout: 60000});
  return page.evaluate(() => {
    const small = document.createElement('canvas');
    [small.width, small.height] = [460, 320];
    small.getContext('2d').drawImage(document.getElementById('canvas'), 0, 0, small.width, small.height);
    return small.toDataURL();
  });
}

export async function pressed(page, key) {
  await page.keyboard.press(key);
  return picture(page);
}

// Defects and what is thin, by the keys of the page.
function foundIn({defects, thickness}) {
  if (!thickness) return defects;
  return {...defects, thin_walls: thickness.walls, thin_pins: thickness.pins, narrow_gaps: thickness.gaps, sharp_edges: thickness.edges};
}

// Of "html" in the report: each count that the page has is there, and the verdict is that of the last mesh.
export async function compareCounts(page, html) {
  const shown = await page.$$eval('[data-count]', (cells) => cells.map((cell) => [cell.dataset.count, cell.textContent]));
  const cells = new Map(shown);
  const roles = ['input', 'result'].filter((name) => html[name]);
  for (const role of roles) {
    for (const [key, {count}] of Object.entries(foundIn(html[role].check))) {
      const cell = cells.get(`${role}:${key}`);
      const elsewhere = roles.some((name) => foundIn(html[name].check)[key].count > 0);
      expect(elsewhere ? cell?.replaceAll(',', '') === String(count) : cell === undefined, `${role} ${key}: ${cell}, not ${count}`);
    }
  }
  const verdict = await page.textContent('#verdict');
  expect(verdict.includes('not a valid solid') !== html[roles.at(-1)].check.valid_solid, `verdict: ${verdict}`);
}

// Clicks the name of each kind of defect: it says where the first place is, and something else is seen.
export async function flyToAll(page, html) {
  for (const name of await page.$$('[data-defect]')) {
    const key = await name.getAttribute('data-defect');
    const before = await picture(page);
    await name.click();
    const status = await page.textContent('#status');
    const count = foundIn(html.input.check)[key].count || (html.result && foundIn(html.result.check)[key].count);
    if (/no place/.test(status)) continue;
    expect(new RegExp(`place 1 of ${count.toLocaleString('en-US')} \\(at `).test(status), `${key}: "${status}"`);
    expect(await picture(page) !== before, `${key}: nothing moves`);
  }
}

// Hides and shows the layer of each kind of defect that the mesh has.
export async function toggleLayers(page) {
  for (const box of await page.$$('[data-layer]')) {
    await box.uncheck();
    expect(!await box.isChecked(), 'a layer cannot be hidden');
    await box.check();
  }
}

// The canvas with the line where it is at first, and at the end.
export async function moveSlider(page) {
  await page.click('[data-choice=slider]');
  const handle = await page.$('[role=slider]');
  const before = await picture(page);
  const box = await handle.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + 40);
  await page.mouse.down();
  await page.mouse.move(box.x - 200, box.y + 40, {steps: 4});
  await page.mouse.up();
  const now = Number(await handle.getAttribute('aria-valuenow'));
  expect(now > 10 && now < 40, `slider at ${now}`);
  await handle.focus();
  await page.keyboard.press('End');
  expect(await handle.getAttribute('aria-valuenow') === '100', 'the slider does not take keys');
  return {before, all: await picture(page)};
}

// Two meshes that differ look different, the same ones alike.
export async function compareViews(page, differ) {
  const [first, last] = [await pressed(page, '1'), await pressed(page, '2')];
  expect((first !== last) === differ, `both look ${differ ? 'alike' : 'different'}`);
  const {before, all} = await moveSlider(page);
  expect(!differ || before !== all, 'the slider shows nothing else');
  expect(all === first, 'the slider at its end is not the first mesh');
}

// The pictures of these keys are all different from the one before.
export async function turnByKeys(page, keys) {
  await page.focus('#canvas');
  let last = await picture(page);
  for (const key of keys) {
    const now = await pressed(page, key);
    expect(now !== last, `key ${key} changes nothing`);
    last = now;
  }
}

// What Tab reaches within so many steps: tools, defects, and what else has one of these names.
export async function reachedByTab(page, steps) {
  const reached = new Set();
  for (let i = 0; i < steps; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => {
      const {tool, defect, largest} = document.activeElement.dataset;
      return tool ?? defect ?? largest ?? '';
    }));
  }
  return reached;
}

export async function nameAll(page) {
  const unnamed = await page.$$eval('button, input, canvas, [role=slider]', (elements) => elements.filter((element) =>
      !(element.getAttribute('aria-label') || element.textContent.trim())).map((element) => element.outerHTML));
  expect(unnamed.length === 0, `without a name: ${unnamed}`);
}

export async function onAPhone(browser, file, choice) {
  const page = await opened(browser, file, {viewport: {width: 390, height: 800}, hasTouch: true, isMobile: true});
  expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'wider than a phone');
  const low = await page.$$eval('.tools button', (buttons) => buttons.filter((one) => one.getBoundingClientRect().height < 40).length);
  expect(low === 0, `${low} buttons too small for a finger`);
  await page.tap(`[data-choice=${choice}]`);
  expect(await page.getAttribute('#canvas', 'data-mode') === choice, 'a tap does nothing');
  await page.close();
}
