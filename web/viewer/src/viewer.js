// SPDX-License-Identifier: MIT
// What is seen of a page: the canvas, the tools above it, and the report beside it; and what they do with each other.
import {Plane, Vector3, Vector4} from 'three';

import {Grid} from './decode.js';
import {make} from './dom.js';
import * as facts from './facts.js';
import {distances, heatHeader, pairOf, pairSlider, scaleBox} from './heat.js';
import {Layers} from './layers.js';
import {Stage} from './stage.js';
import {Surface} from './surface.js';
import {keysSection, tools} from './tools.js';
import {coordinate, foundOf, grouped, measure, rough, subjectOf, verdict} from './words.js';

const FAR = 100;  // beyond all that is drawn
const NEAR = 0.12;  // how much is seen around a place, of half of the largest side

export class Viewer {
  // `page` is what the page says of itself, `meshes` what decodeMesh() gave of each of its meshes. Of more than two, a pair is shown.
  constructor(page, meshes) {
    this.whole = page;
    this.page = pairOf(page, 0);
    this.subject = subjectOf(page);
    this.roles = this.page.meshes.map(({role}) => role);
    this.grid = new Grid(page.grid);
    this.cut = {cut: {value: new Vector4(1, 0, 0, 0)}, cutting: {value: false}};
    this.plane = new Plane(new Vector3(1, 0, 0), FAR);
    this.all = page.meshes.map((mesh, m) => new Surface(mesh, meshes[m], this.grid, this.cut, this.plane, page));
    this.surfaces = this.all.slice(0, 2);
    this.paint = this.subject.paint;
    this.measured = null;
    this.layers = new Layers(page, this.surfaces, {changed: () => this.repaint(), go: (...where) => this.go(...where)});
    this.status = make('p', {class: 'status', role: 'status', id: 'status'});
    this.canvas = make('canvas', {tabindex: '0', role: 'img', 'aria-label': this.picture(), id: 'canvas'});
    this.frame = make('div', {class: 'stage'}, this.canvas);
  }

  picture() {
    const names = this.page.meshes.map(({role, triangles}) => `${this.subject.roles[role].toLowerCase()} ${grouped(triangles)} triangles`);
    return `The mesh, ${names.join(', ')}. Arrow keys turn it, plus and minus zoom, N goes to the next place.`;
  }

  start(root) {
    const {page} = this;
    const mode = page.meshes.length > 1 ? (matchMedia('(max-width: 56rem)').matches ? 'slider' : 'both') : this.roles[0];
    this.tools = tools(page, mode, this.paint, this.actions());
    const pairs = pairSlider(this.whole, (i) => this.choosePair(i));
    const main = make('main', {}, ...this.tools.rows, pairs, this.frame, this.status);
    this.header = this.makeHeader();
    this.aside = this.makeAside();
    root.append(this.header, main, this.aside);
    if (page.scale) this.frame.append(scaleBox(page, (share) => this.setTop(share)));
    this.stage = new Stage(this.canvas, this.surfaces, this.cut, page.up);
    this.addSlider();
    this.listen();
    this.repaint();
    this.setMode(mode);
    this.stage.reset();
    this.say(`Drag to turn. ${page.ways ? 'Click the mesh to read a distance.' : 'Click a name at the side to fly to what is wrong.'}`);
  }

  makeHeader() {
    return this.page.ways ? heatHeader(this.page) : facts.header(this.page);
  }

  makeAside() {
    const {page} = this;
    const first = page.ways ? distances(page, (m) => this.flyToLargest(m)) : this.layers.section();
    return make('aside', {'aria-label': 'Report', tabindex: '0'}, first, facts.omitted(page), facts.leftOut(page), facts.operands(page),
        facts.objects(page, (i) => this.flyToObject(i)), facts.legend(page),
        facts.warnings(page), facts.numbers(page), facts.parts(page, (m, place) => this.flyToPart(m, place)), keysSection(), facts.raw(page));
  }

  // The camera, the colours and the cut stay.
  choosePair(i) {
    this.page = pairOf(this.whole, i);
    this.surfaces = this.stage.surfaces = this.all.slice(2 * i, 2 * i + 2);
    const [header, aside] = [this.makeHeader(), this.makeAside()];
    this.header.replaceWith(header);
    this.aside.replaceWith(aside);
    [this.header, this.aside] = [header, aside];
    this.canvas.setAttribute('aria-label', this.picture());
    this.largest = undefined;
    this.ringAt(null);
    this.repaint();
  }

  actions() {
    return {
      mode: (mode) => this.setMode(mode),
      paint: (paint) => this.setPaint(paint),
      wires: (on) => { for (const surface of this.all) surface.wires(on); this.stage.draw(); },
      cut: (state) => this.setCut(state),
      measure: (on) => this.startMeasuring(on),
      reset: () => this.wholeView(),
      look: () => this.changeLook(),
      step: (step) => this.step(step),
      near: (factor) => this.stage.near(factor),
      slide: (by) => this.slide(this.stage.split + by),
    };
  }

  step(step) {
    if (this.page.ways) return this.flyToLargest(this.largest === 0 ? 1 : 0);
    return this.layers.step(step) || this.say('There is nothing wrong to go to.');
  }

  setTop(share) {
    for (const {material} of this.all) material.uniforms.top.value = share;
    this.stage.draw();
  }

  say(text) {
    this.status.textContent = text;
  }

  repaint() {
    for (const surface of this.surfaces) surface.paint(this.paint, this.layers.shown);
    this.stage.draw();
  }

  setPaint(paint) {
    this.paint = paint;
    this.repaint();
    const beside = !matchMedia('(max-width: 56rem)').matches;
    if (paint === 'fate' && beside) document.getElementById('legend').scrollIntoView({block: 'nearest'});
    if (paint === 'defects' && beside) document.getElementById('defects').scrollIntoView({block: 'nearest'});
  }

  setMode(mode) {
    this.stage.mode = mode;
    this.handle.style.display = mode === 'slider' ? '' : 'none';
    const tags = this.roles.includes(mode) ? [mode] : this.roles;
    this.tags.forEach((tag, i) => {
      tag.style.display = this.page.meshes.length > 1 && tags[i] ? '' : 'none';
      tag.textContent = tags[i] ? this.subject.roles[tags[i]] : '';
    });
    this.tags[0].style.left = '.5rem';
    this.tags[1].style.left = mode === 'both' ? 'calc(50% + .5rem)' : '';
    this.tags[1].style.right = mode === 'both' ? '' : '.5rem';
    this.canvas.dataset.mode = mode;
    this.stage.draw();
  }

  addSlider() {
    this.tags = [make('span', {class: 'tag'}), make('span', {class: 'tag'})];
    this.handle = make('div', {class: 'handle', role: 'slider', tabindex: '0', 'aria-label': 'Line between both',
      'aria-valuemin': '0', 'aria-valuemax': '100'});
    this.handle.addEventListener('pointerdown', (event) => this.handle.setPointerCapture(event.pointerId));
    this.handle.addEventListener('pointermove', (event) => {
      if (!this.handle.hasPointerCapture(event.pointerId)) return;
      const box = this.frame.getBoundingClientRect();
      this.slide((event.clientX - box.left) / box.width);
    });
    this.handle.addEventListener('keydown', (event) => {
      const by = {ArrowLeft: -0.05, ArrowRight: 0.05, Home: -1, End: 1}[event.key];
      if (by === undefined) return;
      this.slide(this.stage.split + by);
      event.preventDefault();
      event.stopPropagation();
    });
    this.frame.append(...this.tags, this.handle);
    this.slide(0.5);
  }

  slide(share) {
    this.stage.split = Math.max(0, Math.min(1, share));
    this.handle.style.left = `${100 * this.stage.split}%`;
    this.handle.setAttribute('aria-valuenow', String(Math.round(100 * this.stage.split)));
    this.stage.move();
  }

  listen() {
    let down = null;
    this.canvas.addEventListener('pointerdown', (event) => { down = [event.offsetX, event.offsetY]; });
    this.canvas.addEventListener('pointerup', (event) => {
      if (down && Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) < 5) this.click(event.offsetX, event.offsetY);
      down = null;
    });
    this.canvas.addEventListener('keydown', (event) => {
      const turn = {ArrowLeft: [-0.12, 0], ArrowRight: [0.12, 0], ArrowUp: [0, 0.12], ArrowDown: [0, -0.12]}[event.key];
      if (!turn) return;
      this.stage.turn(...turn);
      event.preventDefault();
    });
    addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches?.('input[type=range]')) return;
      this.tools.taken[event.key.toLowerCase()]?.();
    });
    addEventListener('beforeprint', () => this.stage.renderNow());
  }

  click(x, y) {
    const hit = this.stage.hit(x, y);
    if (this.measured) return this.measurePlace(hit);
    if (!hit) return undefined;
    const where = hit.place.toArray().map((value, axis) => coordinate(this.grid.own(value, axis), 2 * this.grid.half)).join(', ');
    const which = this.page.meshes.length > 1 ? `${this.subject.roles[hit.surface.facts.role]}: ` : '';
    return this.say(`${which}${this.whatIsAt(hit)} (at ${where})`);
  }

  whatIsAt({surface, triangle, place, onFace}) {
    if (onFace) return 'inside the solid, where it is cut open';
    if (!this.page.scale) return surface.describe(triangle);
    const other = this.page.meshes.find((mesh) => mesh !== surface.facts);
    const value = surface.valueAt(triangle, place) * (this.page.scale.most ?? NaN);
    return `${measure(Number(value.toPrecision(3)))} from ${this.subject.roles[other.role]}`;
  }

  startMeasuring(on) {
    this.measured = on ? [] : null;
    this.stage.measure([]);
    this.say(on ? 'Click two places of the mesh.' : '');
  }

  measurePlace(hit) {
    if (!hit) return this.say('There is no mesh there. Click two places of the mesh.');
    this.measured = this.measured.length === 1 ? [this.measured[0], hit.place] : [hit.place];
    this.stage.measure(this.measured);
    if (this.measured.length === 1) return this.say('Click a second place.');
    const [a, b] = this.measured;
    const side = (axis) => coordinate(this.grid.length(Math.abs(a[axis] - b[axis])), 2 * this.grid.half);
    const along = ['x', 'y', 'z'].map((axis) => `${axis} ${side(axis)}`).join(', ');
    return this.say(`Distance: ${rough(this.grid.length(a.distanceTo(b)))} (${along}), in ${this.page.units}`);
  }

  setCut({on, axis, share, flip}) {
    const reach = this.grid.middle[axis] * 2 / this.grid.most * 1.001;
    const sign = flip ? -1 : 1;
    const normal = [0, 0, 0];
    normal[axis] = sign;
    this.cut.cut.value.set(...normal, sign * (2 * share - 1) * reach);
    this.plane.normal.set(...normal).negate();
    this.plane.constant = on ? this.cut.cut.value.w : FAR;
    this.cut.cutting.value = on;
    this.stage.draw();
  }

  go(surface, key, at) {
    if (!surface) return this.say('These have no place that could be shown.');
    const {at: places} = surface.facts.places[key];
    const place = this.grid.drawnPlace(places.slice(3 * at, 3 * at + 3));
    if (this.paint !== 'defects') this.tools.rows[0].querySelector('[data-choice=defects]').click();
    this.showSurface(surface);
    this.ringAt(place);
    const {bit} = this.page.looks.find((look) => look.key === key);
    this.stage.look(place, NEAR, surface, surface.normalAt(place, bit));
    const {count, first} = foundOf(surface.facts.check, key);
    const thick = first[at]?.thickness;
    const words = this.layers.buttons.get(key).textContent;
    const where = place.map((value, axis) => coordinate(this.grid.own(value, axis), 2 * this.grid.half)).join(', ');
    return this.say(`${words}: place ${grouped(at + 1)} of ${grouped(count)} (at ${where})${thick === undefined ? '' : `, ${measure(thick)} thick`}`);
  }

  // Where one alone is shown.
  showSurface(surface) {
    const {role} = surface.facts;
    if (this.stage.mode !== role && this.roles.includes(this.stage.mode)) this.tools.modes?.set(role);
  }

  flyToLargest(m) {
    this.largest = m;
    const way = this.page.ways[m];
    const place = this.grid.drawnPlace(way.at);
    this.showSurface(this.surfaces[m]);
    this.ringAt(place);
    this.stage.look(place, 2 * NEAR, this.surfaces[m], this.surfaces[m].normalAt(place, null));
    const where = place.map((value, axis) => coordinate(this.grid.own(value, axis), 2 * this.grid.half)).join(', ');
    const [own, other] = m === 0 ? ['A', 'B'] : ['B', 'A'];
    this.say(`${own} is ${measure(way.largest)} from ${other} here (at ${where})`);
  }

  ringAt(place) {
    for (const {ring} of this.surfaces) {
      ring.visible = place !== null;
      if (!place) continue;
      ring.geometry.getAttribute('position').array.set(place);
      ring.geometry.getAttribute('position').needsUpdate = true;
    }
  }

  flyToPart(m, place) {
    this.showSurface(this.surfaces[m]);
    const at = this.grid.drawnPlace(place);
    this.surfaces.forEach((surface, i) => surface.choosePart(i === m ? at : null));
    this.showChosen();
    this.ringAt(at);
    this.stage.look(at, 3 * NEAR, this.surfaces[m], this.surfaces[m].normalAt(at, null));
  }

  // Of all meshes, before and after.
  flyToObject(i) {
    const m = this.page.meshes.findIndex(({objects}) => objects[i]?.place);
    for (const surface of this.surfaces) surface.chooseObject(i);
    this.showChosen();
    if (m < 0) return this.say('It has no triangles.');
    const {centre, radius} = this.surfaces[m].objectBox(i);
    this.ringAt(null);
    this.stage.lookFromHere(centre, Math.max(1.2 * radius, NEAR / 4));
    const whose = (role) => this.surfaces.length > 1 ? `${this.subject.roles[role].toLowerCase()} ` : '';
    const verdicts = this.page.meshes.map(({role, objects}) => `${whose(role)}${verdict(objects[i])}`).join(', ');
    return this.say(`${this.page.meshes[m].objects[i].name}: ${verdicts}`);
  }

  // Looks of files would hide it.
  showChosen() {
    if (this.paint === 'looks') this.tools.rows[0].querySelector('[data-choice=plain]').click();
    else this.repaint();
  }

  wholeView() {
    this.ringAt(null);
    for (const surface of this.surfaces) surface.choosePart(null);
    this.repaint();
    this.stage.reset();
  }

  changeLook() {
    const root = document.documentElement;
    const dark = root.dataset.look ? root.dataset.look === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
    root.dataset.look = dark ? 'light' : 'dark';
  }
}
