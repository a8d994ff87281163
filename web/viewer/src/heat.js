// SPDX-License-Identifier: MIT
// Distances as colours: the scale, and the numbers beside it.
import {button, make, table} from './dom.js';
import {grouped, measure} from './words.js';

// From nothing to the top of the scale, in equal steps; ever darker, so that they can be told apart without seeing colours.
export const HEAT = [[232, 236, 241], [253, 214, 112], [243, 132, 54], [206, 49, 74], [104, 14, 90]];

const ways = {a: 'A to B', b: 'B to A'};

// What a page says of one of its pairs.
export function pairOf(page, i) {
  if (page.meshes.length <= 2) return page;
  return {...page, meshes: page.meshes.slice(2 * i, 2 * i + 2), ways: page.ways.slice(2 * i, 2 * i + 2)};
}

// Chooses one of several pairs: `change` is called with its number. Nothing where there is one.
export function pairSlider(page, change) {
  const pairs = page.meshes.length / 2;
  if (pairs <= 1) return null;
  const label = make('output', {id: 'pair'});
  const show = (i) => {
    const {name, triangles} = page.meshes[2 * i + 1];
    label.textContent = `B ${i + 1} of ${pairs}: ${name}, ${grouped(triangles)} triangles`;
  };
  const range = make('input', {type: 'range', min: '0', max: String(pairs - 1), step: '1', value: '0', 'data-tool': 'pair',
    'aria-label': 'Which B', oninput: () => {
      show(Number(range.value));
      change(Number(range.value));
    }});
  show(0);
  return make('div', {class: 'pairs'}, range, label);
}

// The bar with its numbers. `change` is called with the top of the scale, as a share of the largest distance.
export function scaleBox(page, change) {
  const most = page.scale.most ?? NaN;  // beyond the range of doubles
  const bar = make('div', {class: 'bar', 'aria-hidden': 'true'});
  bar.style.background = `linear-gradient(to right, ${HEAT.map((colour) => `rgb(${colour.join(',')})`).join(', ')})`;
  const labels = [0, 0.5, 1].map(() => make('span'));
  const show = (share) => labels.forEach((label, i) => {
    label.textContent = `${measure(Number((most * share * i / 2).toPrecision(3)))}${i === 2 && share < 1 ? ' or more' : ''}`;
  });
  const range = make('input', {type: 'range', min: '-3', max: '0', step: '0.05', value: '0', 'data-tool': 'top', 'aria-label': 'Top of the scale',
    title: 'Top of the scale', oninput: () => {
      const share = 10 ** Number(range.value);
      show(share);
      change(share);
    }});
  show(1);
  return make('div', {class: 'scale', role: 'group', 'aria-label': `Colours of distances, in ${page.units}`},
      make('div', {}, `Distance, in ${page.units}`), bar, make('div', {class: 'labels'}, ...labels), range);
}

// What is measured, each way. `fly` is called with the number of the mesh.
export function distances(page, fly) {
  const row = (words, of) => [words, ...page.ways.map((way) => measure(of(way)))];
  const rows = [row('On average', (way) => way.mean), row('Root mean square', (way) => way.rms), row('Largest found', (way) => way.largest)];
  if (page.ways.some(({bound}) => bound !== null)) rows.push(row('Nowhere more than', (way) => way.bound));
  const list = table(['', ...page.meshes.map(({role}) => ways[role])], rows, {id: 'distances'});
  const buttons = page.meshes.map(({role}, m) => button(`Where ${role.toUpperCase()} is farthest`, {'data-largest': role, onclick: () => fly(m)}));
  return make('section', {}, make('h2', {}, 'Distances'), make('p', {}, `In ${page.units}. From ${grouped(page.ways[0].samples)} places of A to ` +
      `the nearest place of B, and from ${grouped(page.ways[1].samples)} of B to A.`), make('div', {class: 'wide'}, list),
      make('p', {class: 'row'}, ...buttons));
}

export function heatHeader(page) {
  const [a, b] = page.meshes;
  const largest = Math.max(...page.ways.map((way) => way.largest ?? NaN));
  return make('header', {}, make('h1', {}, `A: ${a.name}, B: ${b.name}`), make('p', {class: 'verdict', id: 'verdict'}, largest === 0 ?
      'No place of one is away from the other.' : `Up to ${measure(largest)} apart, in ${page.units}.`));
}
