// SPDX-License-Identifier: MIT
// The page: a file goes in, is checked at once and shown, is repaired and taken home. It holds no geometry.

import {formats} from 'meshrepair';
import {PackageEngine} from './engine.js';

const MESHES = /\.(stl|obj|off|ply|glb|gltf|3mf|om|xyz|pts|pwn|pcd)(\.(gz|zst|zip))?$/i;
const STAGES = {
  read: 'Reading', valid: 'Looking', clean: 'Cleaning', sew: 'Sewing', holes: 'Closing holes', orient: 'Turning triangles',
  arrange: 'Cutting triangles', tree: 'Dividing space', cells: 'Making cells', cover: 'Covering cells',
  inside: 'Finding what is solid', extract: 'Taking the surface', simplify: 'Simplifying', certify: 'Certifying', check: 'Checking',
  write: 'Writing', html: 'Drawing',
};

const by = (id) => document.getElementById(id);
let engine = null;
let urls = [];  // of what is shown and offered
let done = 0;  // pieces of work

function show(id, isShown) {
  by(id).hidden = !isShown;
}

function say(message, kind) {
  const verdict = by('verdict');
  verdict.textContent = message;
  verdict.className = kind;
  verdict.hidden = false;
}

function list(id, items) {
  by(id).replaceChildren(...items.map((item) => {
    const entry = document.createElement('li');
    entry.append(item);
    return entry;
  }));
  show(id, items.length > 0);
}

function urlOf(bytes, type) {
  const url = URL.createObjectURL(new Blob([bytes], {type}));
  urls.push(url);
  return url;
}

function forget() {
  urls.forEach((url) => URL.revokeObjectURL(url));
  urls = [];
  list('downloads', []);
  list('warnings', []);
}

function downloadOf({name, bytes}) {
  const link = document.createElement('a');
  link.className = 'download';
  link.download = name;
  link.href = urlOf(bytes, 'application/octet-stream');
  link.textContent = `Download ${name}`;
  return link;
}

function progressed({stage, share}) {
  by('stage').textContent = `${STAGES[stage] ?? stage} …`;
  const bar = by('bar');
  if (share > 0) {
    bar.value = share;
  } else {
    bar.removeAttribute('value');
  }
}

// Another frame for each page: browsers may leave one blank that was hidden when its address changed.
function showPage(page) {
  const frame = by('viewer').cloneNode();
  frame.hidden = !page;
  if (page) {
    frame.src = urlOf(page, 'text/html');
  } else {
    frame.removeAttribute('src');
  }
  by('viewer').replaceWith(frame);
}

// Shows what came of `work`, and while it lasts how far it is.
async function during(work) {
  forget();
  show('options', false);
  show('work', true);
  progressed({stage: 'read', share: 0});
  document.body.dataset.state = 'busy';
  try {
    const made = await work();
    say(made.message, made.isGood ? 'good' : 'bad');
    list('warnings', made.warnings);
    list('downloads', (made.files ?? []).map(downloadOf));
    showPage(made.page);
  } catch (error) {
    say(error.name === 'AbortError' ? 'Cancelled.' : `${error.message}.`.replace(/\.\.$/, '.'), 'bad');
  }
  show('work', false);
  show('options', true);
  document.body.dataset.state = 'ready';
  document.body.dataset.done = ++done;
  by('repair').focus();
}

function choose(files) {
  const all = [...files];
  const file = all.find(({name}) => MESHES.test(name)) ?? all[0];
  if (!file) return;
  engine?.cancel();
  const mine = engine = new PackageEngine(file, all.filter((other) => other !== file));
  showPage(null);
  const format = /\.([^.]+)(\.(gz|zst|zip))?$/.exec(file.name)?.[1].toLowerCase();
  by('options').elements.to.value = formats.includes(format) ? format : 'stl';
  say(file.name, '');
  during(() => mine.check(progressed));
}

function chosenOptions() {
  return Object.fromEntries([...new FormData(by('options'))].filter(([, value]) => value !== ''));
}

function listen() {
  const drop = by('drop');
  by('file').addEventListener('change', ({target}) => {
    choose(target.files);
    target.value = '';
  });
  drop.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter' && event.key !== ' ') return;
    event.preventDefault();
    by('file').click();
  });
  // Anywhere on the page: one that misses the field would open the file otherwise.
  for (const name of ['dragenter', 'dragover']) {
    addEventListener(name, (event) => {
      event.preventDefault();
      drop.classList.add('over');
    });
  }
  addEventListener('dragleave', () => drop.classList.remove('over'));
  addEventListener('drop', (event) => {
    event.preventDefault();
    drop.classList.remove('over');
    choose(event.dataTransfer.files);
  });
  by('options').addEventListener('submit', (event) => {
    event.preventDefault();
    const options = chosenOptions();
    during(() => engine.repair(options, progressed));
  });
  by('cancel').addEventListener('click', () => engine.cancel());
  addEventListener('keydown', (event) => {
    if (event.key === 'Escape') engine?.cancel();
  });
}

by('options').elements.to.append(...formats.map((format) => new Option(format.toUpperCase(), format)));
listen();
document.body.dataset.state = 'empty';
// From then on the page works without a network.
navigator.serviceWorker?.register('offline.js').catch(() => {});
