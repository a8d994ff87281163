// SPDX-License-Identifier: MIT
// The page: reads what is embedded in it, and shows it.
//
// The element "facts" has JSON: program, version, subject (a key of words.js), up, units, grid, looks (of defects), meshes, left_out and
// report; of a Boolean operation also operands, of distances also ways and scale, with a pair of meshes for each B. A mesh has its role,
// name, triangles, points, shown, simplified, has_values, not_finite, size, kinds, places, part_places, objects, check (null: it was not
// checked) and looks (null: it has none). Its triangles are in "mesh-0", "mesh-1" and so on, its looks in "looks-0", pictures in
// "picture-0".
import {decodeMesh} from './decode.js';
import {button, make} from './dom.js';
import {decodeLooks, decodePicture, Looks} from './looks.js';
import {PLAIN} from './surface.js';
import {Viewer} from './viewer.js';

function embedded(id) {
  return document.getElementById(id)?.textContent;
}

// Those of each mesh that has some, and the pictures that they share.
async function addLooks(page, surfaces) {
  const pictures = [];
  for (let i = 0; embedded(`picture-${i}`) !== undefined; ++i) pictures.push(decodePicture(embedded(`picture-${i}`)));
  const all = await Promise.all(pictures);
  await Promise.all(page.meshes.map(async ({looks, shown}, m) => {
    if (!looks) return;
    surfaces[m].setLooks(new Looks(looks, await decodeLooks(embedded(`looks-${m}`), looks, shown), all, PLAIN));
  }));
}

async function start() {
  const root = document.getElementById('page');
  try {
    const page = JSON.parse(embedded('facts'));
    document.title = `${page.meshes[0].name} \u2013 ${page.program}`;
    const packed = page.meshes.map((_, m) => embedded(`mesh-${m}`));
    const meshes = await Promise.all(page.meshes.map((mesh, m) => decodeMesh(packed[m], mesh)));
    const viewer = new Viewer(page, meshes);
    await addLooks(page, viewer.surfaces);
    viewer.start(root);
    root.dataset.ready = 'yes';
  } catch (error) {
    root.append(make('p', {class: 'bad', role: 'alert'}, `This page cannot be shown: ${error.message}. It needs WebGL 2 and a browser of ` +
        '2023 or later.'), button('Try again', {onclick: () => location.reload()}));
    throw error;
  }
}

start();
