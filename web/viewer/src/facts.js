// The report as a page: verdict, numbers, parts, legend.
import {make, swatch, table} from './dom.js';
import {grouped, measure, plain, reasons, roleWords, rough, verdict} from './words.js';

function sentence(facts) {
  const {check} = facts;
  return `${verdict(check)}${check.valid_solid ? '' : `: ${reasons(check)}`}`;
}

export function header(page) {
  const first = page.meshes[0], last = page.meshes.at(-1);
  const good = last.check.valid_solid;
  const parts = [make('h1', {}, first.name),
    make('p', {class: `verdict ${good ? 'good' : 'bad'}`, id: 'verdict'},
        `${good ? '\u2714' : '\u2718'} ${page.meshes.length > 1 ? 'Now ' : 'This is '}${sentence(last)}`)];
  if (page.meshes.length > 1) parts.push(make('p', {}, `Before: ${sentence(first)}`));
  return make('header', {}, ...parts);
}

function sides(page, facts) {
  const grid = page.grid;
  return facts.size.map((steps) => rough(steps / (2 ** grid.bits - 1) * grid.half * 2)).join(' \u00d7 ');
}

export function numbers(page) {
  const heads = ['', ...page.meshes.map(({role}) => page.meshes.length > 1 ? roleWords[role] : 'Value')];
  const row = (words, of) => [words, ...page.meshes.map((facts) => of(facts.check, facts))];
  const rows = [
    row('Triangles', (check) => grouped(check.triangles)),
    row('Points', (check) => grouped(check.points)),
    row('Volume', (check) => check.volume === null ? 'not closed' : measure(check.volume)),
    row('Area', (check) => measure(check.area)),
    row('Size', (_, facts) => sides(page, facts)),
    row('Separate parts', (check) => grouped(check.parts)),
    row('Cavities', (check) => grouped(check.cavities)),
  ];
  return make('section', {}, make('h2', {}, 'Numbers'), make('p', {}, `In ${page.units}.`),
      make('div', {class: 'wide'}, table(heads, rows)));
}

export function parts(page, fly) {
  const lists = page.meshes.map((facts, m) => {
    const rows = facts.check.first_parts.map((part, i) => {
      const name = make('button', {type: 'button', onclick: () => fly(m, facts.part_places[i]), 'aria-label': `Fly to part ${i + 1}`},
          String(i + 1));
      return [name, grouped(part.triangles), part.closed ? measure(part.volume) : 'open', measure(part.area)];
    });
    const caption = page.meshes.length > 1 ? make('h3', {}, roleWords[facts.role]) : null;
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
    return make('div', {}, table([roleWords[facts.role], 'Triangles'], rows));
  });
  return make('section', {id: 'legend'}, make('h2', {}, 'What became of each triangle'),
      make('p', {}, 'Colours of \u201cWhat became of it\u201d, above the picture.'), ...lists);
}

// Says where not all is drawn.
export function omitted(page) {
  const lines = page.meshes.filter(({check, shown, not_finite}) => shown + not_finite < check.triangles).map(({role, check, shown}) =>
    make('p', {}, `${roleWords[role]}: ${grouped(shown)} of ${grouped(check.triangles)} triangles are drawn: those at fault, and every ` +
        'so many of the others. All counts are of the whole mesh.'));
  return lines.length > 0 ? make('section', {id: 'omitted'}, make('h2', {}, 'Not all is drawn'), ...lines) : null;
}

export function raw(page) {
  return make('section', {class: 'raw'}, make('details', {}, make('summary', {}, 'All numbers of the report'),
      make('pre', {tabindex: '0'}, JSON.stringify(page.report, null, 2))),
      make('p', {}, `Made by ${page.program} ${page.version}.`));
}
