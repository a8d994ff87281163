// SPDX-License-Identifier: MIT
// Opens pages of meshes from elsewhere in a browser, as view_html.mjs does.
//
// Usage: node view_corpus.mjs PROGRAMS CORPUS
//
// Prints a line for each fault. Exit code 0: there is none, 1: some, 77: there is no such folder, or what view_html.mjs needs.
import {existsSync} from 'node:fs';
import path from 'node:path';

import {about, compareCounts, compareViews, flyToAll, nameAll, onAPhone, opened, repaired, toggleLayers, turnByKeys,
  withBrowser} from './pages.mjs';

const SOUND = ['odedstein__goathead.obj', 'cinolib__bamboo_pen.obj'];
const BROKEN = ['vhacd__al.obj', 'cherchi-arr__three_cubes.stl', 'trimesh__box.stl', 'odedstein__plane_holes.obj', 'vhacd__blonde.obj',
  'trimesh__multibody.stl'];

const [programs, corpus] = process.argv.slice(2).map((name) => path.resolve(name));
const folderOf = path.join(corpus, 'meshes');
if (!existsSync(folderOf)) {
  console.log(`there is no ${folderOf}`);
  process.exit(77);
}

async function view(browser, folder, name) {
  about(name);
  const {page: file, report} = repaired(programs, folder, path.join(folderOf, name));
  const page = await opened(browser, file);
  await compareCounts(page, report.html);
  await flyToAll(page, report.html);
  await toggleLayers(page);
  await nameAll(page);
  await page.keyboard.press('r');
  await compareViews(page, BROKEN.includes(name));
  await turnByKeys(page, ['3', 'ArrowLeft', 'ArrowUp', '+', 'w', 'x', 'r']);
  await page.close();
  await onAPhone(browser, file, 'result');
}

await withBrowser(async ({browser, folder}) => {
  for (const name of [...SOUND, ...BROKEN]) await view(browser, folder, name);
});
