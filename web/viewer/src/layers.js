// SPDX-License-Identifier: MIT
// The list of defects: shows and hides each kind, and goes from place to place.
import {button, make, swatch} from './dom.js';
import {defectWords, foundOf, grouped, subjectOf} from './words.js';

export class Layers {
  // `go` is called with the surface, the key, and the number of the place.
  constructor(page, surfaces, {changed, go}) {
    const {looks} = page;
    this.subject = subjectOf(page);
    this.looks = looks;
    this.surfaces = surfaces;
    this.changed = changed;
    this.go = go;
    this.shown = new Set(looks.map((look) => look.key));
    this.at = new Map();
    this.buttons = new Map();
  }

  counts(key) {
    return this.surfaces.map(({facts}) => foundOf(facts.check, key).count);
  }

  section() {
    const present = this.looks.filter(({key}) => this.counts(key).some((count) => count > 0));
    const absent = this.looks.filter((look) => !present.includes(look));
    const two = this.surfaces.length > 1;
    const heads = two ? this.surfaces.map(({facts}) => this.subject.roles[facts.role]) : ['Count'];
    const head = make('tr', {}, make('td'), make('th', {scope: 'col'}, 'Kind'),
        ...heads.map((text) => make('th', {scope: 'col', class: 'number'}, text)));
    const list = make('table', {class: 'layers'}, make('thead', {}, head), make('tbody', {}, ...present.map((look) => this.row(look))));
    const none = absent.map(({key}) => defectWords[key][0].toLowerCase()).join(', ');
    return make('section', {'aria-labelledby': 'defects'}, make('h2', {id: 'defects'}, this.subject.found),
        present.length > 0 ? make('p', {}, 'Click a name to fly to a place; click again for the next one.') :
            make('p', {class: 'good'}, 'Nothing was found.'),
        present.length > 0 ? make('div', {class: 'wide'}, list) : null,
        present.length > 0 && none ? make('p', {class: 'none'}, `None of these: ${none}.`) : null);
  }

  row({key, colour}) {
    const [words, help] = defectWords[key];
    const counts = this.counts(key);
    const box = make('input', {type: 'checkbox', checked: true, 'aria-label': `Show: ${words}`, 'data-layer': key,
      onchange: () => {
        box.checked ? this.shown.add(key) : this.shown.delete(key);
        this.changed();
      }});
    const next = button('', {title: help, 'data-defect': key, onclick: () => this.next(key, 1)});
    next.append(swatch(colour), words);
    this.buttons.set(key, next);
    return make('tr', {}, make('td', {}, box), make('td', {}, next, make('p', {}, help)),
        ...counts.map((count, i) => make('td', {class: 'number', 'data-count': `${this.surfaces[i].facts.role}:${key}`}, grouped(count))));
  }

  // Where one can fly to: those of the first mesh that has some.
  places(key) {
    const surface = this.surfaces.find(({facts}) => facts.places[key].at.length > 0);
    return surface ? {surface, count: surface.facts.places[key].at.length / 3} : {count: 0};
  }

  next(key, step) {
    const {surface, count} = this.places(key);
    for (const [other, element] of this.buttons) element.setAttribute('aria-current', String(other === key));
    this.current = key;
    if (count === 0) return this.go(null, key, 0);
    const at = this.at.has(key) ? (this.at.get(key) + step + count) % count : 0;
    this.at.set(key, at);
    this.go(surface, key, at);
  }

  // The next place of all, whatever its kind.
  step(step) {
    const keys = this.looks.map(({key}) => key).filter((key) => this.places(key).count > 0);
    if (keys.length === 0) return false;
    const current = keys.includes(this.current) ? this.current : keys[0];
    const {count} = this.places(current);
    const at = this.at.get(current);
    const leaves = at !== undefined && (step > 0 ? at === count - 1 : at === 0);
    const key = leaves ? keys[(keys.indexOf(current) + step + keys.length) % keys.length] : current;
    if (leaves && key !== current) this.at.delete(key);
    this.next(key, step);
    return true;
  }
}
