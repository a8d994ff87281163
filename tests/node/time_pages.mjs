// SPDX-License-Identifier: MIT
// How large pages of --html are, how soon they are ready, and how fast they draw, without a graphics card.
//
// Usage: node time_pages.mjs PROGRAM TRIANGLES...
//
// PROGRAM is meshrepair. It gets bumpy spheres of about so many triangles. Prints a line for each: seconds of the program, bytes of the
// page, milliseconds until it is ready and until it shows the first whole picture, pictures a second while it is turned, of both meshes
// side by side and of one, and milliseconds of a whole picture of both. Exit code 77: as view_html.mjs.
import {spawnSync} from 'node:child_process';
import {statSync, writeFileSync} from 'node:fs';
import path from 'node:path';

import {opened, withBrowser} from './pages.mjs';

const SECONDS = 5;  // for which it is turned

function place(ring, rings, step, steps) {
  const [down, around] = [Math.PI * ring / rings, 2 * Math.PI * (step % steps) / steps];
  const radius = 50 + 2.5 * Math.sin(7 * down) * Math.cos(5 * around);
  return [Math.sin(down) * Math.cos(around), Math.sin(down) * Math.sin(around), Math.cos(down)].map((x) => radius * x);
}

// As OBJ: two points at the poles, and rings of as many quadrilaterals as there are twice as many rings.
function bumpySphere(triangles) {
  const rings = Math.max(3, Math.round(Math.sqrt(triangles / 4)) + 1), steps = 2 * (rings - 1);
  const lines = [`v ${place(0, rings, 0, steps).join(' ')}`, `v ${place(rings, rings, 0, steps).join(' ')}`];
  const number = (ring, step) => ring === 0 ? 1 : ring === rings ? 2 : 3 + (ring - 1) * steps + step % steps;
  for (let ring = 1; ring < rings; ++ring) {
    for (let step = 0; step < steps; ++step) lines.push(`v ${place(ring, rings, step, steps).join(' ')}`);
  }
  for (let ring = 0; ring < rings; ++ring) {
    for (let step = 0; step < steps; ++step) {
      const [a, b, c, d] = [number(ring, step), number(ring, step + 1), number(ring + 1, step), number(ring + 1, step + 1)];
      if (ring > 0) lines.push(`f ${a} ${c} ${b}`);
      if (ring < rings - 1) lines.push(`f ${b} ${c} ${d}`);
    }
  }
  return `${lines.join('\n')}\n`;
}

const whole = (page) => page.waitForFunction(() => document.getElementById('canvas').dataset.drawn === 'yes', null, {timeout: 120000});

// Pictures a second.
async function turned(page) {
  await page.waitForTimeout(1500);
  return page.evaluate(async (seconds) => {
    const {dataset} = document.getElementById('canvas');
    const canvas = document.getElementById('canvas');
    const [begin, before] = [performance.now(), Number(dataset.frames)];
    while (performance.now() - begin < 1000 * seconds) {
      canvas.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft', bubbles: true}));
      await new Promise((done) => requestAnimationFrame(done));
    }
    return 1000 * (Number(dataset.frames) - before) / (performance.now() - begin);
  }, SECONDS);
}

// Until its pixels are there.
async function wholePicture(page) {
  await page.keyboard.press('3');
  await whole(page);
  return page.evaluate(async () => {
    const canvas = document.getElementById('canvas');
    const pixel = new Uint8Array(4);
    const context = canvas.getContext('webgl2');
    const read = () => context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, pixel);
    read();
    const begin = performance.now();
    dispatchEvent(new Event('beforeprint'));
    read();
    return performance.now() - begin;
  });
}

async function timed(program, browser, folder, triangles) {
  const [mesh, file] = ['sphere.obj', 'page.html'].map((name) => path.join(folder, name));
  writeFileSync(mesh, bumpySphere(triangles));
  const begin = performance.now();
  spawnSync(program, ['-q', mesh, path.join(folder, 'out.obj'), '--html', file]);
  const written = (performance.now() - begin) / 1000;
  const opening = performance.now();
  const page = await opened(browser, file);
  const ready = performance.now() - opening;
  await whole(page);
  const first = performance.now() - opening;
  const both = await turned(page);
  const picture = await wholePicture(page);
  await page.keyboard.press('1');
  const one = await turned(page);
  await page.close();
  console.log(`${triangles} triangles: ${written.toFixed(2)} s, ${statSync(file).size} bytes, ready ${ready.toFixed(0)} ms, whole ` +
      `${first.toFixed(0)} ms, turned ${both.toFixed(1)} /s (one ${one.toFixed(1)} /s), a whole picture ${picture.toFixed(0)} ms`);
}

const [program, ...counts] = process.argv.slice(2);
await withBrowser(async ({browser, folder}) => {
  for (const count of counts) await timed(path.resolve(program), browser, folder, Number(count));
});
