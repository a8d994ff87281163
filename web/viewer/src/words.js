// SPDX-License-Identifier: MIT
// What things are called, for people who have never seen a mesh from within.

export const defectWords = {
  open_edges: ['Open edges', 'The surface ends here: the rim of a hole or of a gap. Nothing tells inside from outside.'],
  nonmanifold_edges: ['Edges of more than two triangles', 'Walls meet here that cannot belong to one skin.'],
  nonmanifold_vertices: ['Points where parts only touch', 'Two parts hang together by a single point.'],
  inconsistent_edges: ['Edges between opposite facings', 'Neighbours disagree about which side is outside.'],
  inside_out_parts: ['Parts that are inside out', 'The outside of a part faces what it should enclose.'],
  self_intersections: ['Pairs of triangles that intersect', 'The surface passes through itself.'],
  degenerate_triangles: ['Triangles without area', 'A triangle has shrunk to a line or to a point.'],
  duplicate_triangles: ['Duplicate triangles', 'The same triangle is there more than once.'],
  not_finite_triangles: ['Triangles that are not finite', 'A coordinate is infinite, or no number.'],
  unused_points: ['Points that no triangle uses', 'Left over. They do no harm.'],
  thin_walls: ['Thin walls', 'The wall is thinner than the limit. It may break, or not be printed at all.'],
  thin_pins: ['Thin pins', 'Thinner than the limit in both directions across.'],
  narrow_gaps: ['Narrow gaps', 'Two faces are nearer than the limit. They may fuse.'],
  sharp_edges: ['Sharp edges', 'An edge of a small angle is thinner than the limit near its tip.'],
};

// What the section of what is thin calls them.
const thinKinds = {thin_walls: 'walls', thin_pins: 'pins', narrow_gaps: 'gaps', sharp_edges: 'edges'};

// What a check has found of a kind: the count and the first places.
export function foundOf(check, key) {
  return check.defects[key] ?? check.thickness[thinKinds[key]];
}

// What a page is about, and what is said of it then.
const subjects = {
  repair: {roles: {input: 'Before', result: 'After'}, found: 'What was wrong', kinds: 'What became of it',
    legend: 'What became of each triangle', paint: 'defects'},
  check: {roles: {input: 'Value'}, found: 'What is wrong', paint: 'defects'},
  boolean: {roles: {input: 'Operands', result: 'Result'}, found: 'What is wrong', kinds: 'Where it comes from',
    legend: 'Where each triangle comes from', paint: 'fate'},
  distance: {roles: {a: 'A', b: 'B'}, paint: 'heat'},
};

export function subjectOf(page) {
  return subjects[page.subject];
}

export function grouped(number) {
  return number.toLocaleString('en-US');
}

export function measure(number) {
  if (number === null || number === undefined || !Number.isFinite(number)) return 'unknown';
  if (number !== 0 && (Math.abs(number) >= 1e7 || Math.abs(number) < 1e-4)) return number.toExponential(4);
  return Number(number.toPrecision(6)).toLocaleString('en-US', {maximumSignificantDigits: 6});
}

// Command lines call the input IN.
export function plain(words) {
  return words.replace(/\bIN\b/, 'the input');
}

// What is known to a step of the grid.
export function rough(number) {
  return measure(Number(number.toPrecision(5)));
}

// Of a place in a mesh of this size.
export function coordinate(number, size) {
  if (!Number.isFinite(number)) return 'unknown';
  const digits = Math.max(0, Math.ceil(5 - Math.log10(size)) - 1);
  return digits > 12 || Math.abs(number) >= 1e9 ? number.toExponential(4) : String(Number(number.toFixed(digits)));
}

// Why a mesh is no solid.
export function reasons(check) {
  const found = (key) => check.defects[key].count > 0;
  const list = [];
  if (check.triangles === 0) list.push('it has no triangles');
  if (found('open_edges')) list.push('it has holes or gaps');
  if (found('self_intersections')) list.push('it passes through itself');
  if (found('nonmanifold_edges') || found('nonmanifold_vertices')) list.push('walls meet where they cannot');
  if (found('inconsistent_edges') || found('inside_out_parts')) list.push('some of it faces the wrong way');
  if (found('duplicate_triangles') || found('degenerate_triangles')) list.push('it has useless triangles');
  if (found('not_finite_triangles')) list.push('some coordinates are no numbers');
  if (list.length === 0) list.push('it encloses nothing');
  return list.join(', ');
}

export function verdict(check) {
  return check.valid_solid ? 'a valid solid' : 'not a valid solid';
}
