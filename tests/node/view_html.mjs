// Opens pages of --html in a browser: what they show is what the reports say.
//
// Usage: node view_html.mjs PROGRAMS MESHES
//
// Prints a line for each fault. Exit code 0: there is none, 1: some, 77: there is no playwright (scripts/setup.sh all installs it) or
// no Chromium.

import {spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';

const CHROMIUM = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
const DRAWING = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];
const BROKEN = ['broken_torus_box.stl', 'broken_spheres.obj', 'overlapping_spheres.off', 'open_bowl.ply'];
const SOUND = ['cube.stl', 'hollow_sphere.obj'];

const [programs, meshes] = process.argv.slice(2).map((name) => path.resolve(name));
const folder = mkdtempSync(path.join(tmpdir(), 'view_html_'));
let faults = 0;
let subject = '';

function expect(holds, what) {
  if (holds) return;
  console.log(`${subject}: ${what}`);
  ++faults;
}

// The page and the report of a mesh.
function made(program, mesh, ...more) {
  const [page, report] = ['html', 'json'].map((ending) => path.join(folder, `${program}_${mesh}.${ending}`));
  const out = program === 'meshrepair' ? [path.join(folder, 'out.obj')] : [];
  spawnSync(path.join(programs, program), ['-q', path.join(meshes, mesh), ...out, '--html', page, '--report', report, ...more]);
  return {page, report: JSON.parse(readFileSync(report, 'utf8')).html};
}

async function opened(browser, file, options = {}) {
  const page = await browser.newPage({viewport: {width: 1280, height: 800}, reducedMotion: 'reduce', ...options});
  page.on('console', (message) => expect(message.type() !== 'error', `console: ${message.text()}`));
  page.on('pageerror', (error) => expect(false, `error: ${error.message}`));
  page.on('request', (request) => expect(request.url() === `file://${encodeURI(file)}`, `asks for ${request.url()}`));
  await page.goto(`file://${encodeURI(file)}`);
  await page.waitForSelector('#page[data-ready]', {timeout: 120000});
  return page;
}

// Once all that was asked for is drawn.
async function picture(page) {
  return page.evaluate(async () => {
    for (let i = 0; i < 3; ++i) await new Promise((done) => requestAnimationFrame(done));
    return document.getElementById('canvas').toDataURL();
  });
}

async function pressed(page, key) {
  await page.keyboard.press(key);
  return picture(page);
}

async function compareCounts(page, report) {
  const shown = await page.$$eval('[data-count]', (cells) => cells.map((cell) => [cell.dataset.count, cell.textContent]));
  const cells = new Map(shown);
  for (const role of ['input', 'result'].filter((name) => report[name])) {
    for (const [key, {count}] of Object.entries(report[role].check.defects)) {
      const cell = cells.get(`${role}:${key}`);
      const elsewhere = ['input', 'result'].some((name) => report[name]?.check.defects[key].count > 0);
      expect(elsewhere ? cell?.replaceAll(',', '') === String(count) : cell === undefined, `${role} ${key}: ${cell}, not ${count}`);
    }
  }
  const verdict = await page.textContent('#verdict');
  const last = report.result ?? report.input;
  expect(verdict.includes('not a valid solid') !== last.check.valid_solid, `verdict: ${verdict}`);
}

async function flyToAll(page, report) {
  for (const name of await page.$$('[data-defect]')) {
    const key = await name.getAttribute('data-defect');
    const before = await picture(page);
    await name.click();
    const status = await page.textContent('#status');
    const count = report.input.check.defects[key].count || report.result?.check.defects[key].count;
    if (/no place/.test(status)) continue;
    expect(new RegExp(`place 1 of ${count.toLocaleString('en-US')} \\(at `).test(status), `${key}: "${status}"`);
    expect(await picture(page) !== before, `${key}: nothing moves`);
  }
}

async function moveSlider(page) {
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
async function compareViews(page, differ) {
  const [input, result] = [await pressed(page, '1'), await pressed(page, '2')];
  expect((input !== result) === differ, `before and after look ${differ ? 'alike' : 'different'}`);
  const {before, all} = await moveSlider(page);
  expect(!differ || before !== all, 'the slider shows nothing else');
  expect(all === input, 'the slider at its end is not the mesh before');
}

async function useKeys(page) {
  for (const [key, mode] of [['1', 'input'], ['2', 'result'], ['3', 'both'], ['4', 'slider'], ['3', 'both']]) {
    await page.keyboard.press(key);
    expect(await page.getAttribute('#canvas', 'data-mode') === mode, `key ${key} does not show ${mode}`);
  }
  await page.focus('#canvas');
  let last = await picture(page);
  for (const key of ['ArrowLeft', 'ArrowUp', '+', 'w', 'w', 'x', 'x', 'n', 'r']) {
    const now = await pressed(page, key);
    expect(now !== last, `key ${key} changes nothing`);
    last = now;
  }
  const reached = new Set();
  for (let i = 0; i < 80; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => document.activeElement.dataset.tool ?? document.activeElement.dataset.defect ?? ''));
  }
  for (const name of ['wires', 'cut', 'measure', 'reset', 'open_edges']) expect(reached.has(name), `Tab does not reach ${name}`);
}

async function measureSomething(page) {
  await pressed(page, '1');
  await page.keyboard.press('m');
  const box = await (await page.$('#canvas')).boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2 + 25);
  await page.mouse.click(box.x + box.width / 2 + 25, box.y + box.height / 2 + 25);
  const status = await page.textContent('#status');
  expect(/^Distance: [\d.]+ \(x [\d.]+, y [\d.]+, z [\d.]+\), in /.test(status), `measured: "${status}"`);
}

async function nameAll(page) {
  const unnamed = await page.$$eval('button, input, canvas, [role=slider]', (elements) => elements.filter((element) =>
      !(element.getAttribute('aria-label') || element.textContent.trim())).map((element) => element.outerHTML));
  expect(unnamed.length === 0, `without a name: ${unnamed}`);
}

async function onAPhone(browser, file) {
  const page = await opened(browser, file, {viewport: {width: 390, height: 800}, hasTouch: true, isMobile: true});
  expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'wider than a phone');
  const low = await page.$$eval('.tools button', (buttons) => buttons.filter((one) => one.getBoundingClientRect().height < 40).length);
  expect(low === 0, `${low} buttons too small for a finger`);
  await page.tap('[data-choice=result]');
  expect(await page.getAttribute('#canvas', 'data-mode') === 'result', 'a tap does nothing');
  await page.close();
}

async function sayWhatIsLeftOut(browser) {
  const {page: file, report} = made('meshcheck', 'broken_torus_box.stl', '--html-triangles', '900');
  const page = await opened(browser, file);
  expect(/: 900 of 2,325 triangles are drawn/.test(await page.textContent('#omitted')), 'does not say what is left out');
  await compareCounts(page, report);
  await page.close();
}

async function withoutWebGl(playwright, file) {
  const browser = await playwright.chromium.launch({executablePath: CHROMIUM, args: ['--no-sandbox', '--disable-3d-apis']});
  const page = await browser.newPage();
  await page.goto(`file://${encodeURI(file)}`);
  const said = await page.waitForSelector('[role=alert]', {timeout: 60000});
  expect(/WebGL/.test(await said.textContent()), 'does not say that WebGL is not there');
  await browser.close();
}

async function main() {
  let playwright;
  try {
    playwright = await import('playwright-core');
  } catch (error) {
    console.log(`playwright is not installed: ${error.code}`);
    return 77;
  }
  if (!CHROMIUM) {
    console.log('there is no Chromium');
    return 77;
  }
  const browser = await playwright.chromium.launch({executablePath: CHROMIUM, args: DRAWING});
  for (const program of ['meshrepair', 'meshcheck']) {
    for (const mesh of [...BROKEN, ...SOUND]) {
      subject = `${program} ${mesh}`;
      const {page: file, report} = made(program, mesh);
      const page = await opened(browser, file);
      await compareCounts(page, report);
      await flyToAll(page, report);
      await nameAll(page);
      await page.keyboard.press('r');
      if (program === 'meshrepair') await compareViews(page, BROKEN.includes(mesh));
      await page.close();
    }
  }
  subject = 'broken_torus_box.stl';
  const file = path.join(folder, 'meshrepair_broken_torus_box.stl.html');
  const page = await opened(browser, file);
  await useKeys(page);
  await measureSomething(page);
  await page.close();
  await onAPhone(browser, file);
  await sayWhatIsLeftOut(browser);
  await browser.close();
  await withoutWebGl(playwright, file);
  return faults === 0 ? 0 : 1;
}

const code = await main().finally(() => rmSync(folder, {recursive: true}));
process.exit(code);
