// SPDX-License-Identifier: MIT
// The report as a page: verdict, numbers, parts, legend.
import {make, swatch, table} from './dom.js';
import {grouped, measure, plain, reasons, rough, subjectOf, verdict} from './words.js';

function sentence(facts) {
  const {check, objects: list} = facts;
  const bad = list.filter(({valid_solid: valid}) => !valid).length;
  if (list.length > 1 && bad === 0) return `${grouped(list.length)} valid solids`;
  if (list.length > 1) return `${grouped(bad)} of ${grouped(list.length)} objects not a valid solid: ${reasons(check)}`;
  return `${verdict(check)}${check.valid_solid ? '' : `: ${reasons(check)}`}`;
}

// The title, the verdict, and what there is to say beside it.
function headerWords(page) {
  const first = page.meshes[0], last = page.meshes.at(-1);
  if (page.subject === 'check') return [first.name, `This is ${sentence(last)}`, null];
  if (page.subject === 'repair') return [first.name, `Now ${sentence(last)}`, `Before: ${sentence(first)}`];
  const broken = page.operands.filter(({valid_solid: valid}) => !valid).length;
  return [last.name, last.triangles === 0 ? 'Nothing is solid' : `The result is ${sentence(last)}`,
    `Of ${page.operands.map(({name}) => name).join(', ')}${broken > 0 ? `; ${grouped(broken)} of them no valid solid` : ''}`];
}

export function header(page) {
  const last = page.meshes.at(-1);
  const good = last.check.valid_solid || (page.subject === 'boolean' && last.triangles === 0);
  const [title, said, more] = headerWords(page);
  return make('header', {}, make('h1', {}, title), make('p', {class: `verdict ${good ? 'good' : 'bad'}`, id: 'verdict'},
      `${good ? '\u2714' : '\u2718'} ${said}`), more ? make('p', {}, more) : null);
}

function sides(page, facts) {
  const grid = page.grid;
  return facts.size.map((steps) => rough(steps / (2 ** grid.bits - 1) * grid.half * 2)).join(' \u00d7 ');
}

// What may have made another object of it, first.
export function warnings(page) {
  const list = page.report.warnings;
  if (list.length === 0) return null;
  const sorted = [...list].sort((a, b) => b.changes_object - a.changes_object);
  return make('section', {id: 'warnings'}, make('h2', {}, 'Warnings'),
      make('ul', {}, ...sorted.map(({code, text}) => make('li', {'data-code': code}, `${text} [${code}]`))));
}

export function numbers(page) {
  const heads = ['', ...page.meshes.map(({role}) => subjectOf(page).roles[role])];
  const row = (words, of) => [words, ...page.meshes.map((facts) => of(facts.check, facts))];
  const checked = page.meshes.every(({check}) => check !== null);
  const rows = [
    row('Triangles', (_, facts) => grouped(facts.triangles)),
    row('Points', (_, facts) => grouped(facts.points)),
    row('Size', (_, facts) => sides(page, facts)),
    ...(checked ? [
      row('Volume', (check) => check.volume === null ? 'not closed' : measure(check.volume)),
      row('Area', (check) => measure(check.area)),
      row('Separate parts', (check) => grouped(check.parts)),
      row('Cavities', (check) => grouped(check.cavities)),
    ] : []),
  ];
  return make('section', {}, make('h2', {}, 'Numbers'), make('p', {}, `In ${page.units}.`),
      make('div', {class: 'wide'}, table(heads, rows)));
}

// Each mesh that was combined.
export function operands(page) {
  if (!page.operands) return null;
  const rows = page.operands.map(({name, triangles, volume}, i) => [
    make('span', {}, swatch(page.meshes[0].kinds[i].colour), name), grouped(triangles), volume === null ? 'not closed' : measure(volume)]);
  const list = table(['Mesh', 'Triangles', 'Volume'], rows);
  return make('section', {id: 'operands'}, make('h2', {}, 'Operands'), make('div', {class: 'wide'}, list));
}

// The meshes of a scene; `fly` is called with the number of one.
export function objects(page, fly) {
  const {objects: list} = page.meshes[0];
  if (list.length === 0) return null;
  const two = page.meshes.length > 1;
  const state = (object) => object ? `${grouped(object.triangles)} ${object.valid_solid ? '\u2714' : '\u2718'}` : '';
  const rows = list.map(({name}, i) => [
    make('button', {type: 'button', onclick: () => fly(i), 'data-object': String(i), 'aria-label': `Fly to ${name}`}, name),
    ...page.meshes.map((facts) => state(facts.objects[i]))]);
  return make('section', {id: 'objects'}, make('h2', {}, 'Objects'),
      make('p', {}, 'Each is a mesh of its own: how many triangles it has, and \u2714 where it is a valid solid.'),
      make('div', {class: 'wide'}, table(['Name', ...(two ? page.meshes.map(({role}) => subjectOf(page).roles[role]) : ['Triangles'])], rows)));
}

export function parts(page, fly) {
  if (page.meshes.some(({check}) => check === null)) return null;
  const lists = page.meshes.map((facts, m) => {
    const rows = facts.check.first_parts.map((part, i) => {
      const name = make('button', {type: 'button', onclick: () => fly(m, facts.part_places[i]), 'aria-label': `Fly to part ${i + 1}`},
          String(i + 1));
      return [name, grouped(part.triangles), part.closed ? measure(part.volume) : 'open', measure(part.area)];
    });
    const caption = page.meshes.length > 1 ? make('h3', {}, subjectOf(page).roles[facts.role]) : null;
    const more = facts.check.parts - rows.length;
    return make('div', {class: 'wide'}, caption, table(['Part', 'Triangles', 'Volume', 'Area'], rows, {'data-parts': facts.role}),
        more > 0 ? make('p', {}, `And ${grouped(more)} more.`) : null);
  });
  const heading = make('summary', {}, 'Parts');
  const note = make('p', {}, 'A part is what hangs together. The wall of a cavity has a negative volume.');
  return make('section', {}, make('details', {open: page.meshes.every(({check}) => check.parts <= 12)}, heading, note, ...lists));
}

export function legend(page) {
  if (page.meshes.every(({kinds}) => kinds.length === 0)) return null;
  const lists = page.meshes.map((facts) => {
    const rows = facts.kinds.filter(({count}) => count > 0).map(({key, words, colour, count}) => [
      make('span', {}, swatch(colour), plain(words)), make('span', {'data-kind': `${facts.role}:${key}`}, grouped(count))]);
    return make('div', {}, table([subjectOf(page).roles[facts.role], 'Triangles'], rows));
  });
  return make('section', {id: 'legend'}, make('h2', {}, subjectOf(page).legend),
      make('p', {}, `Colours of \u201c${subjectOf(page).kinds}\u201d, above the picture.`), ...lists);
}

// Says where not all is drawn.
export function omitted(page) {
  const whose = (role) => page.meshes.length > 1 ? `${subjectOf(page).roles[role]}: ` : '';
  const lines = page.meshes.filter(({simplified}) => simplified).map(({role, triangles, shown}) =>
    make('p', {}, `${whose(role)}${grouped(shown)} triangles are drawn instead of ${grouped(triangles)}: those at fault as they are, the ` +
        'others simplified. All counts are of the whole mesh.'));
  return lines.length > 0 ? make('section', {id: 'omitted'}, make('h2', {}, 'Not all is drawn'), ...lines) : null;
}

// Pictures that are not in the page.
export function leftOut(page) {
  if (page.left_out.length === 0) return null;
  const lines = page.left_out.map((line) => make('p', {}, `${line}.`));
  return make('section', {id: 'left-out'}, make('h2', {}, 'Pictures that are not shown'), ...lines);
}

export function raw(page) {
  return make('section', {class: 'raw'}, make('details', {}, make('summary', {}, 'All numbers of the report'),
      make('pre', {tabindex: '0'}, JSON.stringify(page.report, null, 2))),
      make('p', {}, `Made by ${page.program} ${page.version}.`));
}
