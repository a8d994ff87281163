// SPDX-License-Identifier: MIT
// What the modules of the viewer compute, without a browser.
//
// Usage: node --test viewer_modules.mjs
import assert from 'node:assert/strict';
import test from 'node:test';

import {coarseMesh} from '../../web/viewer/src/coarse.js';
import {Grid} from '../../web/viewer/src/decode.js';
import {partsOf} from '../../web/viewer/src/parts.js';
import {coordinate, measure, reasons} from '../../web/viewer/src/words.js';

const MOST = 2 ** 18 - 1;  // steps of the grid
const TETRAHEDRON = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];

// A wavy sheet of two triangles for each of its squares.
function sheet(side) {
  const places = new Int32Array(3 * (side + 1) ** 2), corners = [];
  for (let y = 0; y <= side; ++y) {
    for (let x = 0; x <= side; ++x) {
      const height = 0.5 + 0.4 * Math.sin(6 * x / side);
      places.set([x / side, y / side, height].map((share) => Math.round(share * MOST)), 3 * (y * (side + 1) + x));
      const at = y * (side + 1) + x;
      if (x < side && y < side) corners.push(at, at + 1, at + side + 2, at, at + side + 2, at + side + 1);
    }
  }
  return {corners: Uint32Array.from(corners), places};
}

test('a coarse mesh has no more triangles than wanted, and they are those of the mesh', () => {
  const mesh = sheet(300);
  for (const wanted of [20000, 3000, 500]) {
    const {source, corners} = coarseMesh(mesh, MOST, wanted);
    assert.ok(source.length <= wanted && source.length > wanted / 8, `${source.length} for ${wanted}`);
    assert.equal(corners.length, 3 * source.length);
    assert.ok(source.every((t, i) => i === 0 || t > source[i - 1]));
    const points = mesh.places.length / 3;
    for (let i = 0; i < corners.length; i += 3) {
      const triangle = corners.subarray(i, i + 3);
      assert.equal(new Set(triangle).size, 3);
      assert.ok(triangle.every((p) => p < points));
    }
  }
});

test('a coarse mesh reaches as far as the mesh', () => {
  const mesh = sheet(200);
  const {corners} = coarseMesh(mesh, MOST, 5000);
  for (let axis = 0; axis < 2; ++axis) {
    const along = Array.from(corners, (p) => mesh.places[3 * p + axis]);
    assert.ok(Math.min(...along) < 0.05 * MOST && Math.max(...along) > 0.95 * MOST);
  }
});

test('parts hang together through edges, not through points', () => {
  const apart = partsOf(Uint32Array.from([...TETRAHEDRON, ...TETRAHEDRON.map((p) => p + 4)]));
  assert.deepEqual([new Set(apart.slice(0, 4)).size, new Set(apart.slice(4)).size, new Set(apart).size], [1, 1, 2]);
  const touching = partsOf(Uint32Array.from([...TETRAHEDRON, ...TETRAHEDRON.map((p) => p === 0 ? 0 : p + 3)]));
  assert.equal(new Set(touching).size, 2);
  assert.equal(new Set(partsOf(sheet(60).corners)).size, 1);
  assert.equal(partsOf(new Uint32Array(0)).length, 0);
});

test('places of the grid are drawn around its middle, and found again', () => {
  const grid = new Grid({bits: 18, low: [10, 20, 30], half: 4, high: [MOST, MOST / 2, 0]});
  assert.deepEqual(grid.drawnPlace([0, 0, 0]), [-1, -0.5, 0]);
  assert.deepEqual([-1, 0.5, 0].map((value, axis) => grid.own(value, axis)), [10, 24, 30]);
  assert.equal(grid.length(0.5), 2);
});

test('numbers are as exact as they are known', () => {
  assert.equal(measure(1234.5678), '1,234.57');
  assert.equal(measure(1e-7), '1.0000e-7');
  assert.equal(measure(NaN), 'unknown');
  assert.equal(measure(null), 'unknown');
  assert.equal(coordinate(1.23456789, 2), '1.2346');
  assert.equal(coordinate(-0.000001, 2), '0');
});

test('a mesh that is no solid says why', () => {
  const check = (found, triangles = 4) => ({triangles, defects: new Proxy({}, {get: (_, key) => ({count: found.includes(key) ? 1 : 0})})});
  assert.equal(reasons(check(['open_edges', 'self_intersections'])), 'it has holes or gaps, it passes through itself');
  assert.equal(reasons(check([], 0)), 'it has no triangles');
  assert.equal(reasons(check([])), 'it encloses nothing');
});
