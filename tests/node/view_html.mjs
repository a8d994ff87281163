// SPDX-License-Identifier: MIT
// Opens pages of --html in a browser: what they show is what the reports say.
//
// Usage: node view_html.mjs PROGRAMS MESHES
//
// Prints a line for each fault. Exit code 0: there is none, 1: some, 77: there is no playwright (scripts/setup.sh all installs it) or
// no Chromium.
import {copyFileSync, writeFileSync} from 'node:fs';
import path from 'node:path';

import {about, compareCounts, compareViews, expect, flyToAll, launched, made, nameAll, onAPhone, opened, picture, pressed, reachedByTab,
  repaired, toggleLayers, turnByKeys, withBrowser} from './pages.mjs';

const [programs, meshes] = process.argv.slice(2).map((name) => path.resolve(name));
const mesh = (name) => path.join(meshes, name);
const program = (name) => path.join(programs, name);

async function viewRepairs({browser, folder}) {
  for (const [name, differ] of [['broken_torus_box.stl', true], ['hollow_sphere.obj', false]]) {
    about(`meshrepair ${name}`);
    const {page: file, report} = repaired(programs, folder, mesh(name));
    const page = await opened(browser, file);
    await compareCounts(page, report.html);
    await flyToAll(page, report.html);
    await toggleLayers(page);
    await nameAll(page);
    await page.keyboard.press('r');
    await compareViews(page, differ);
    if (differ) {
      await useKeys(page);
      await restAWhile(page);
      await chooseAPart(page);
      await measureSomething(page);
      await onAPhone(browser, file, 'result');
    }
    await page.close();
  }
}

async function useKeys(page) {
  for (const [key, mode] of [['1', 'input'], ['2', 'result'], ['3', 'both'], ['4', 'slider'], ['3', 'both']]) {
    await page.keyboard.press(key);
    expect(await page.getAttribute('#canvas', 'data-mode') === mode, `key ${key} does not show ${mode}`);
  }
  await turnByKeys(page, ['ArrowLeft', 'ArrowUp', '+', 'w', 'w', 'x', 'x', 'n', 'r']);
  const reached = await reachedByTab(page, 80);
  for (const name of ['wires', 'cut', 'measure', 'reset', 'open_edges']) expect(reached.has(name), `Tab does not reach ${name}`);
}

// Nothing is drawn where nothing changes.
async function restAWhile(page) {
  await picture(page);
  const frames = await page.getAttribute('#canvas', 'data-frames');
  await page.waitForTimeout(400);
  expect(await page.getAttribute('#canvas', 'data-frames') === frames, 'it draws though nothing changes');
}

async function chooseAPart(page) {
  const before = await picture(page);
  await page.click('[data-parts=result] button');
  expect(await picture(page) !== before, 'a part that is chosen is not seen');
  expect(await pressed(page, 'r') === before, 'a part that was chosen stays so');
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

async function viewCheck({browser, folder}) {
  about('meshcheck open_bowl.ply');
  const {page: file, report} = made(program('meshcheck'), folder, mesh('open_bowl.ply'), '--html-triangles', '900');
  const page = await opened(browser, file);
  await compareCounts(page, report.html);
  await flyToAll(page, report.html);
  const drawn = report.html.input.triangles_shown;
  expect(drawn <= 900, `${drawn} triangles`);
  const said = await page.textContent('#omitted');
  expect(said.includes(`${drawn} triangles are drawn instead of 1,216`), `left out: "${said}"`);
  await page.close();
}

async function viewThin({browser, folder}) {
  about('meshcheck hollow_sphere.obj --thickness');
  const {page: file, report} = made(program('meshcheck'), folder, mesh('hollow_sphere.obj'), '--thickness', '0.395');
  const page = await opened(browser, file);
  await compareCounts(page, report.html);
  await flyToAll(page, report.html);
  await toggleLayers(page);
  expect(/ thick$/.test(await page.textContent('#status')), 'does not say how thick it is');
  await page.close();
}

// A pyramid with a picture on its sides, and without a bottom.
function writePyramid(folder) {
  const file = path.join(folder, 'pyramid.obj');
  copyFileSync(new URL('../../docs/pictures/pawn.png', import.meta.url), path.join(folder, 'sides.png'));
  writeFileSync(path.join(folder, 'pyramid.mtl'), 'newmtl sides\nKd 1 1 1\nmap_Kd sides.png\n');
  writeFileSync(file, ['mtllib pyramid.mtl', 'v 0 0 0', 'v 1 0 0', 'v 1 1 0', 'v 0 1 0', 'v 0.5 0.5 1', 'vt 0 0', 'vt 1 0', 'vt 0.5 1',
    'usemtl sides', ...[[1, 2], [2, 3], [3, 4], [4, 1]].map(([a, b]) => `f ${a}/1 ${b}/2 5/3`), ''].join('\n'));
  return file;
}

async function viewLooks({browser, folder}) {
  about('a mesh with a picture');
  const {page: file} = made(program('meshrepair'), folder, writePyramid(folder), path.join(folder, 'out.obj'));
  const page = await opened(browser, file);
  expect(await page.$$eval('#left-out', (sections) => sections.length) === 0, 'the picture is left out');
  await page.click('[data-choice=plain]');
  const plain = await picture(page);
  await page.click('[data-choice=looks]');
  expect(await picture(page) !== plain, 'it looks as without its picture');
  await turnByKeys(page, ['ArrowLeft', '1', 'w']);
  await page.close();
}

// The operands have the colours of the list, and the result those of what it comes from.
async function viewBoolean({browser, folder}) {
  about('bspbool');
  const {page: file, report} = made(program('bspbool'), folder, mesh('hollow_sphere.obj'), mesh('broken_torus_box.stl'), '--op', 'difference',
      '-o', path.join(folder, 'out.obj'));
  const page = await opened(browser, file);
  await compareCounts(page, report.html);
  await nameAll(page);
  const names = await page.$$eval('#operands tbody tr', (rows) => rows.map((row) => row.textContent));
  expect(names.length === 2 && names[0].startsWith('hollow_sphere.obj1,116'), `operands: ${names}`);
  const kinds = new Map(await page.$$eval('[data-kind]', (cells) => cells.map((cell) => [cell.dataset.kind, cell.textContent])));
  expect(kinds.get('input:operand_1') === '1,116' && kinds.has('result:operand_2'), `kinds: ${[...kinds]}`);
  await compareViews(page, true);
  await page.click('[data-choice=fate]');
  const byOrigin = await picture(page);
  await page.click('[data-choice=plain]');
  expect(await picture(page) !== byOrigin, 'origins have no colours');
  await page.close();
}

async function viewDistance({browser, folder}) {
  about('meshdist');
  const {page: file, report} = made(program('meshdist'), folder, mesh('hollow_sphere.obj'), mesh('cube.stl'));
  const page = await opened(browser, file);
  const cells = await page.$$eval('#distances td', (list) => list.map((cell) => Number(cell.textContent.replaceAll(',', ''))));
  const {a_to_b: forth, b_to_a: back} = report.distance;
  const said = [forth.mean, back.mean, forth.rms, back.rms, forth.hausdorff, back.hausdorff];
  said.forEach((value, i) => expect(Math.abs(cells[i] - value) <= 1e-5 * value, `${cells[i]}, not ${value}`));
  for (const role of ['a', 'b']) {
    const before = await picture(page);
    await page.click(`[data-largest=${role}]`);
    expect(/^[AB] is 0\.[\d]+ from [AB] here/.test(await page.textContent('#status')), 'does not say how far it is');
    expect(await picture(page) !== before, 'does not fly to the largest distance');
  }
  await page.keyboard.press('r');
  await compareViews(page, true);
  await turnByKeys(page, ['3', 'ArrowLeft', 'x', 'n']);
  await changeScale(page);
  await nameAll(page);
  await page.close();
  await onAPhone(browser, file, 'b');
}

// Each level is drawn, with its own numbers; the view stays.
async function viewLevels({browser, folder}) {
  about('meshdist, several');
  const {page: file, report} = made(program('meshdist'), folder, mesh('hollow_sphere.obj'), mesh('cube.stl'), mesh('hollow_sphere.obj'));
  const page = await opened(browser, file);
  await turnByKeys(page, ['2', 'ArrowLeft']);
  const seen = [];
  for (const [i, name] of ['cube.stl', 'hollow_sphere.obj'].entries()) {
    await page.focus('[data-tool=pair]');
    if (i > 0) await page.keyboard.press('ArrowRight');
    expect((await page.textContent('#pair')).startsWith(`B ${i + 1} of 2: ${name}, `), `not ${name}`);
    const mean = Number(await page.textContent('#distances tr:nth-child(1) td:nth-child(2)'));
    const {mean: told} = report.comparisons[i].distance.a_to_b;
    expect(Math.abs(mean - told) <= 1e-5 * told, `${mean}, not ${told}`);
    seen.push(await picture(page));
  }
  expect(seen[0] !== seen[1], 'another B looks the same');
  await page.click('[data-largest=a]');
  await nameAll(page);
  await page.close();
}

async function changeScale(page) {
  const before = await picture(page);
  const top = () => page.textContent('.labels span:last-child');
  expect(await top() === '0.5', `the scale ends at ${await top()}`);
  await page.focus('[data-tool=top]');
  for (let i = 0; i < 20; ++i) await page.keyboard.press('ArrowLeft');
  expect(await top() === '0.05 or more', `the scale ends at ${await top()}`);
  expect(await picture(page) !== before, 'another scale has the same colours');
}

async function viewWithoutWebGl({playwright, folder}) {
  about('without WebGL');
  const browser = await launched(playwright, '--disable-3d-apis');
  const page = await browser.newPage();
  await page.goto(`file://${encodeURI(path.join(folder, 'page.html'))}`);
  const said = await page.waitForSelector('[role=alert]', {timeout: 60000});
  expect(/WebGL/.test(await said.textContent()), 'does not say that WebGL is not there');
  await browser.close();
}

await withBrowser(async (room) => {
  for (const view of [viewRepairs, viewCheck, viewThin, viewLooks, viewBoolean, viewDistance, viewLevels, viewWithoutWebGl]) await view(room);
});
