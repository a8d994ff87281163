// SPDX-License-Identifier: MIT
// Fewer triangles of a mesh, for as long as it moves.

const MOST_CELLS = 96;  // along a side

// The numbers of the first point in each cell of a grid of so many cells along a side, one for each point.
function firstInCell(places, most, cells) {
  const first = new Int32Array((cells + 1) ** 3).fill(-1);
  const moved = new Uint32Array(places.length / 3);
  for (let p = 0; p < moved.length; ++p) {
    let cell = 0;
    for (let axis = 0; axis < 3; ++axis) cell = cell * (cells + 1) + Math.floor(places[3 * p + axis] / most * cells);
    if (first[cell] < 0) first[cell] = p;
    moved[p] = first[cell];
  }
  return moved;
}

// The triangles that have three corners still when the points of each cell are one: their numbers, and those corners. `most` is the
// number of steps along a side of the grid that places count.
export function coarseMesh({corners, places}, most, wanted) {
  for (let cells = MOST_CELLS; ; cells = Math.floor(cells * 0.75)) {
    const moved = firstInCell(places, most, cells);
    const source = [], kept = [];
    for (let t = 0; t < corners.length / 3; ++t) {
      const [a, b, c] = [moved[corners[3 * t]], moved[corners[3 * t + 1]], moved[corners[3 * t + 2]]];
      if (a === b || b === c || c === a) continue;
      source.push(t);
      kept.push(a, b, c);
    }
    if (source.length <= wanted || cells < 8) return {source: Uint32Array.from(source), corners: Uint32Array.from(kept)};
  }
}
