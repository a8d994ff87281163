// SPDX-License-Identifier: MIT
// Draws the pictures of docs/showing.md#pages-for-browsers: pages of --html in a browser.
//
// Usage: node picture_pages.mjs PROGRAMS MESHES FOLDER
//
// Writes html_repair.jpg, html_distance.jpg and html_boolean.jpg. Exit code 77: as view_html.mjs.
import path from 'node:path';

import {made, opened, picture, repaired, withBrowser} from './pages.mjs';

const [programs, meshes, folder] = process.argv.slice(2).map((name) => path.resolve(name));
const mesh = (name) => path.join(meshes, name);

async function draw(browser, file, name, keys) {
  const page = await opened(browser, file, {viewport: {width: 1000, height: 560}});
  for (const key of keys) await page.keyboard.press(key);
  await picture(page);
  await page.screenshot({path: path.join(folder, name), type: 'jpeg', quality: 72});
  await page.close();
}

await withBrowser(async ({browser, folder: work}) => {
  await draw(browser, repaired(programs, work, mesh('broken_torus_box.stl')).page, 'html_repair.jpg', ['3']);
  const distance = made(path.join(programs, 'meshdist'), work, mesh('broken_torus_box.stl'), path.join(work, 'out.obj'));
  await draw(browser, distance.page, 'html_distance.jpg', ['3']);
  const combined = made(path.join(programs, 'bspbool'), work, mesh('hollow_sphere.obj'), mesh('cube.stl'), '--op', 'difference', '-o',
      path.join(work, 'part.obj'));
  await draw(browser, combined.page, 'html_boolean.jpg', ['3', 'x']);
});
