// SPDX-License-Identifier: MIT
// The rows of buttons above the canvas, and what keys do.
import {button, make} from './dom.js';
import {subjectOf} from './words.js';

const BOTH = {both: 'Side by side', slider: 'Slider'};
const KEYS = [['\u2190 \u2191 \u2192 \u2193', 'turn'], ['+  \u2212', 'nearer, farther'], ['1 2 3 4', 'the first, the second, side by side, slider'],
  ['N  P', 'next, previous place'], ['W', 'wireframe'], ['X', 'cut open'], ['M', 'measure'], ['R', 'the whole mesh again'],
  ['[  ]', 'move the slider']];

function choice(label, choices, chosen, choose) {
  const group = make('div', {class: 'group', role: 'group', 'aria-label': label});
  const buttons = new Map();
  const set = (key) => {
    for (const [other, element] of buttons) element.setAttribute('aria-pressed', String(other === key));
    choose(key);
  };
  for (const [key, text] of Object.entries(choices)) {
    buttons.set(key, button(text, {'aria-pressed': String(key === chosen), 'data-choice': key, onclick: () => set(key)}));
  }
  group.append(...buttons.values());
  return {group, set: (key) => buttons.has(key) && set(key)};
}

function toggle(text, name, change) {
  const element = button(text, {'aria-pressed': 'false', 'data-tool': name, onclick: () => {
    const on = element.getAttribute('aria-pressed') !== 'true';
    element.setAttribute('aria-pressed', String(on));
    change(on);
  }});
  return element;
}

function paintsOf(page) {
  if (page.scale) return {heat: 'Distance', plain: 'Plain'};
  const {kinds} = subjectOf(page);
  const hasLooks = page.meshes.some(({looks}) => looks !== null);
  return {defects: 'Defects', ...(kinds ? {fate: kinds} : {}), ...(hasLooks ? {looks: 'As it looks'} : {}), plain: 'Plain'};
}

// `act` has the functions that the buttons call. Gives the rows, and a function that takes the keys.
export function tools(page, mode, paint, act) {
  const two = page.meshes.length > 1;
  const roles = page.meshes.map(({role}) => role);
  const names = Object.fromEntries(roles.map((role) => [role, subjectOf(page).roles[role]]));
  const modes = two ? choice('What is shown', {...names, ...BOTH}, mode, act.mode) : null;
  const paints = choice('Colours', paintsOf(page), paint, act.paint);
  const wires = toggle('Wireframe', 'wires', act.wires);
  const measure = toggle('Measure', 'measure', act.measure);
  const cutRow = cutTools(page, act.cut);
  const cut = toggle('Cut open', 'cut', (on) => cutRow.show(on));
  const reset = button('Reset', {title: 'The whole mesh again', 'data-tool': 'reset', onclick: act.reset});
  const look = button('\u25d0', {'aria-label': 'Light or dark', title: 'Light or dark', 'data-tool': 'look', onclick: act.look});
  const row = make('div', {class: 'tools', role: 'toolbar', 'aria-label': 'View'}, modes?.group, paints.group, wires, cut, measure, reset, look);
  const taken = {
    1: () => modes?.set(roles[0]), 2: () => modes?.set(roles[1]), 3: () => modes?.set('both'), 4: () => modes?.set('slider'),
    n: () => act.step(1), p: () => act.step(-1), w: () => wires.click(), x: () => cut.click(), m: () => measure.click(), r: act.reset,
    '+': () => act.near(0.8), '=': () => act.near(0.8), '-': () => act.near(1.25), '[': () => act.slide(-0.05), ']': () => act.slide(0.05),
  };
  return {rows: [row, cutRow.row], modes, taken};
}

function cutTools(page, change) {
  const state = {on: false, axis: 0, share: 0.5, flip: false};
  const tell = () => change(state);
  const axis = choice('Cut along', {0: 'X', 1: 'Y', 2: 'Z'}, '0', (key) => {
    state.axis = Number(key);
    tell();
  });
  const range = make('input', {type: 'range', min: '0', max: '1', step: '0.002', value: '0.5', 'aria-label': 'Where it is cut', oninput: () => {
    state.share = Number(range.value);
    tell();
  }});
  const flip = toggle('Other side', 'flip', (on) => {
    state.flip = on;
    tell();
  });
  const row = make('div', {class: 'cut', hidden: true}, axis.group, range, flip);
  row.style.display = 'none';
  return {row, show: (on) => {
    state.on = on;
    row.hidden = !on;
    row.style.display = on ? '' : 'none';
    tell();
  }};
}

export function keysSection() {
  return make('section', {class: 'keys'}, make('details', {}, make('summary', {}, 'Mouse, touch and keys'),
      make('p', {}, 'Drag turns, wheel or two fingers zoom and move, right button moves. A click says what a triangle is.'),
      make('dl', {}, ...KEYS.flatMap(([keys, words]) => [make('dt', {}, make('kbd', {}, keys)), make('dd', {}, words)]))));
}
