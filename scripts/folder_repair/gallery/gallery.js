// SPDX-License-Identifier: MIT
// The list of a folder's meshes. Only the rows in sight are in the document, so that 10,000 of them scroll as 100 do.
'use strict';
(() => {
  const PRINTED = 2000; // rows on paper
  const AROUND = 8; // rows above and below those in sight
  const facts = JSON.parse(document.getElementById('facts').textContent);
  const meshes = facts.rows.map((row) => Object.fromEntries(facts.columns.map((name, i) => [name, row[i]])));
  const at = (id) => document.getElementById(id);
  const number = new Intl.NumberFormat('en-US');
  const unit = (value, digits = 3) => value.toLocaleString('en-US', {maximumSignificantDigits: digits});

  function make(name, attributes = {}, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children.filter((child) => child !== null));
    return element;
  }

  function size(bytes) {
    const units = ['bytes', 'kB', 'MB', 'GB', 'TB'];
    let i = 0;
    for (; bytes >= 999.5 && i < units.length - 1; ++i) bytes /= 1000;
    return `${unit(bytes)} ${units[i]}`;
  }

  // Of the volume, as a share of what it was; NaN where one of them is not known. A mesh may have been inside out.
  function change(mesh) {
    if (mesh.volume_in === null || mesh.volume_out === null) return NaN;
    const [before, after] = [Math.abs(mesh.volume_in), Math.abs(mesh.volume_out)];
    return before === after ? 0 : (after - before) / before;
  }

  function percent(share) {
    if (share === 0) return 'the same';
    if (share > 1e4) return 'was almost 0';
    if (Math.abs(share) < 5e-7) return 'under 0.0001 %';
    return `${share > 0 ? '+' : '\u2212'}${unit(100 * Math.abs(share))} %`;
  }

  const verdict = (mesh) => facts.meanings[mesh.exit_code] ?? `exit code ${mesh.exit_code}`;

  // Columns: what they sort by, and how a cell is drawn.
  const columns = [
    {name: 'look', title: 'Before and after', cell: look},
    {name: 'path', title: 'Name', key: (mesh) => mesh.path, cell: title},
    {name: 'verdict', title: 'Verdict', key: (mesh) => mesh.exit_code, cell: (mesh) =>
      [make('span', {class: mesh.exit_code === 0 ? 'good' : 'bad'}, verdict(mesh))]},
    {name: 'size', number: true, title: 'Triangles', key: (mesh) => mesh.triangles_out ?? mesh.triangles_in, cell: triangles},
    {name: 'volume', number: true, title: 'Volume', key: (mesh) => Math.abs(change(mesh)), cell: volume},
    {name: 'time', number: true, title: 'Time', key: (mesh) => mesh.seconds, cell: (mesh) =>
      [mesh.seconds === null ? '' : `${unit(mesh.seconds)} s`]},
    {name: 'memory', number: true, title: 'Memory', key: (mesh) => mesh.peak_memory_bytes, cell: (mesh) =>
      [mesh.peak_memory_bytes === null ? '' : size(mesh.peak_memory_bytes)]},
  ];

  function look(mesh) {
    if (!mesh.picture) return [make('small', {}, 'no picture')];
    const image = make('img', {src: `${facts.folder}/${mesh.url}.png`, alt: mesh.output === null ? `${mesh.path}, as it is` : `${mesh.path}, before and after`, loading: 'lazy',
      decoding: 'async'});
    return [mesh.page ? make('a', {href: page(mesh), tabindex: '-1', 'aria-hidden': 'true'}, image) : image];
  }

  const page = (mesh) => `${facts.folder}/${mesh.url}.html`;

  function title(mesh) {
    const name = mesh.page ? make('a', {href: page(mesh)}, mesh.path) : mesh.path;
    const out = mesh.output === null ? null : make('small', {}, make('a', {href: `./${mesh.output_url}`, download: ''}, 'result'),
        ` ${size(mesh.bytes_out)}`);
    const lines = [mesh.error, mesh.warnings].filter((line) => line !== null);
    return [name, out, ...lines.map((line) => make('small', {title: line}, line))];
  }

  function triangles(mesh) {
    if (mesh.triangles_out === null) return [mesh.triangles_in === null ? '' : number.format(mesh.triangles_in)];
    return [number.format(mesh.triangles_out), make('small', {}, `were ${number.format(mesh.triangles_in)}`)];
  }

  function volume(mesh) {
    if (mesh.volume_out === null) return [''];
    const share = change(mesh);
    return [Number.isFinite(share) ? percent(share) : 'was no solid', make('small', {}, unit(mesh.volume_out, 6))];
  }

  let sorting = {column: 1, down: false};
  let shown = meshes;
  const hidden = new Set(); // verdicts

  function compare(a, b) {
    const missing = (value) => value === null || Number.isNaN(value);
    const {key} = columns[sorting.column];
    const [x, y] = [key(a), key(b)];
    if (missing(x) || missing(y)) return missing(x) - missing(y); // at the end, up and down
    const order = x < y ? -1 : x > y ? 1 : 0;
    return (sorting.down ? -order : order) || a.place - b.place;
  }

  function choose() {
    const name = at('name').value.toLowerCase();
    const [least, changed, seconds] = ['triangles', 'change', 'seconds'].map((id) => at(id).value === '' ? null : Number(at(id).value));
    shown = meshes.filter((mesh) => !hidden.has(verdict(mesh)) && (name === '' || mesh.path.toLowerCase().includes(name)) &&
      (least === null || (mesh.triangles_out ?? mesh.triangles_in ?? -1) >= least) &&
      (changed === null || 100 * Math.abs(change(mesh)) >= changed) && (seconds === null || (mesh.seconds ?? -1) >= seconds));
    shown.sort(compare);
    at('status').textContent = shown.length === meshes.length ? `${number.format(meshes.length)} meshes` :
      `${number.format(shown.length)} of ${number.format(meshes.length)} meshes`;
    at('table').setAttribute('aria-rowcount', shown.length + 1);
    drawn.clear();
    draw();
    remember();
  }

  // What was chosen stands in the address: it is there again when one comes back from a page.
  function remember() {
    const state = new URLSearchParams();
    for (const id of ['name', 'triangles', 'change', 'seconds']) if (at(id).value !== '') state.set(id, at(id).value);
    if (hidden.size > 0) state.set('without', [...hidden].join('|'));
    if (sorting.column !== 1 || sorting.down) state.set('by', `${columns[sorting.column].name}${sorting.down ? '-' : ''}`);
    history.replaceState(history.state, '', `#${state}`);
  }

  function recall() {
    const state = new URLSearchParams(location.hash.slice(1));
    for (const id of ['name', 'triangles', 'change', 'seconds']) at(id).value = state.get(id) ?? '';
    for (const one of (state.get('without') ?? '').split('|')) if (one) hidden.add(one);
    const by = state.get('by') ?? '';
    const column = columns.findIndex((one) => one.key && one.name === by.replace('-', ''));
    if (column >= 0) sorting = {column, down: by.endsWith('-')};
  }

  const drawn = new Map(); // place in the list -> row
  const above = make('tr', {class: 'space', 'aria-hidden': 'true'}, make('td'));
  const below = above.cloneNode(true);
  let height = 96;

  function row(i) {
    const mesh = shown[i];
    const element = make('tr', {class: 'mesh', 'aria-rowindex': i + 2});
    for (const column of columns) {
      element.append(make(column.name === 'path' ? 'th' : 'td', {class: `${column.name}${column.number ? ' number' : ''}`,
        ...(column.name === 'path' ? {scope: 'row'} : {})}, make('div', {class: 'clip'}, ...column.cell(mesh))));
    }
    return element;
  }

  function draw(all = false) {
    const top = at('rows').getBoundingClientRect().top;
    const first = all ? 0 : Math.max(0, Math.min(shown.length, Math.floor(-top / height) - AROUND));
    const last = all ? Math.min(shown.length, PRINTED) : Math.min(shown.length, Math.ceil((innerHeight - top) / height) + AROUND);
    const focused = document.activeElement?.closest('tr.mesh');
    for (const [i, element] of drawn) if ((i < first || i >= last) && element !== focused) drawn.delete(i);
    for (let i = first; i < last; ++i) if (!drawn.has(i)) drawn.set(i, row(i));
    above.firstChild.style.height = `${first * height}px`;
    below.firstChild.style.height = `${Math.max(0, shown.length - last) * height}px`;
    const wanted = [above, ...[...drawn].sort(([a], [b]) => a - b).filter(([i]) => i >= first && i < last).map(([, one]) => one), below];
    place(wanted);
  }

  // Rows that stay are not moved, so that the one with the focus keeps it.
  function place(wanted) {
    const body = at('rows');
    const kept = new Set(wanted);
    for (const child of [...body.children]) if (!kept.has(child)) child.remove();
    let next = body.firstChild;
    for (const element of wanted) {
      if (element === next) next = next.nextSibling;
      else body.insertBefore(element, next);
    }
  }

  function measure() {
    const probe = at('rows').querySelector('tr.mesh');
    if (!probe) return;
    const now = probe.getBoundingClientRect().height;
    if (now > 0 && Math.abs(now - height) > 0.01) {
      height = now;
      draw();
    }
  }

  function heads() {
    columns.forEach((column, i) => {
      const sorted = i === sorting.column ? (sorting.down ? 'descending' : 'ascending') : 'none';
      const cell = at('heads').children[i] ?? at('heads').appendChild(make('th', {scope: 'col',
        class: `${column.name}${column.number ? ' number' : ''}`}, column.key ? make('button', {type: 'button'}) : column.title));
      if (!column.key) return;
      cell.setAttribute('aria-sort', sorted);
      const mark = {ascending: ' \u25b2', descending: ' \u25bc', none: ''}[sorted];
      cell.firstChild.textContent = column.title + mark;
      cell.firstChild.onclick = () => {
        sorting = {column: i, down: sorting.column === i ? !sorting.down : Boolean(column.number)};
        heads();
        choose();
      };
    });
  }

  function verdicts() {
    const counts = new Map();
    for (const mesh of meshes) counts.set(verdict(mesh), (counts.get(verdict(mesh)) ?? 0) + 1);
    for (const [name, count] of counts) {
      const button = make('button', {type: 'button', 'aria-pressed': String(!hidden.has(name)), 'data-verdict': name},
          `${name} (${number.format(count)})`);
      button.onclick = () => {
        if (!hidden.delete(name)) hidden.add(name);
        button.setAttribute('aria-pressed', String(!hidden.has(name)));
        choose();
      };
      at('verdicts').append(button);
    }
  }

  function start() {
    meshes.forEach((mesh, i) => {
      mesh.place = i;
      mesh.url ??= mesh.path;
      mesh.output_url ??= mesh.output;
    });
    at('about').textContent = facts.about;
    recall();
    verdicts();
    heads();
    choose();
    measure();
    at('filters').addEventListener('input', choose);
    at('filters').addEventListener('submit', (event) => event.preventDefault());
    at('filters').addEventListener('reset', () => setTimeout(() => {
      hidden.clear();
      for (const button of at('verdicts').querySelectorAll('button')) button.setAttribute('aria-pressed', 'true');
      choose();
    }));
    addEventListener('scroll', () => draw(), {passive: true});
    addEventListener('resize', () => { draw(); measure(); });
    addEventListener('beforeprint', () => draw(true));
    addEventListener('afterprint', () => draw());
    document.documentElement.dataset.ready = '';
  }

  start();
})();
