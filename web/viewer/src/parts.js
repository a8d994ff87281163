// SPDX-License-Identifier: MIT
// Which triangles hang together through edges.

// Finds numbers of pairs of points. Open addressing: each slot has the two points and a triangle.
class EdgeTable {
  constructor(edges) {
    let size = 16;
    while (size < 2 * edges) size *= 2;
    this.mask = size - 1;
    this.ends = new Uint32Array(2 * size);
    this.triangle = new Int32Array(size).fill(-1);
  }
  // The triangle that had this edge first: this one, if none had.
  first(a, b, triangle) {
    if (a > b) [a, b] = [b, a];
    let slot = (Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca6b)) >>> 0 & this.mask;
    while (this.triangle[slot] >= 0 && (this.ends[2 * slot] !== a || this.ends[2 * slot + 1] !== b)) slot = (slot + 1) & this.mask;
    if (this.triangle[slot] < 0) [this.ends[2 * slot], this.ends[2 * slot + 1], this.triangle[slot]] = [a, b, triangle];
    return this.triangle[slot];
  }
}

// Of each triangle the number of one in its part, the same for all of the part.
export function partsOf(corners) {
  const count = corners.length / 3;
  const parent = Uint32Array.from({length: count}, (_, t) => t);
  const root = (t) => {
    while (parent[t] !== t) t = parent[t] = parent[parent[t]];
    return t;
  };
  const table = new EdgeTable(corners.length);
  for (let t = 0; t < count; ++t) {
    for (let k = 0; k < 3; ++k) {
      const other = table.first(corners[3 * t + k], corners[3 * t + (k + 1) % 3], t);
      if (other !== t) parent[root(t)] = root(other);
    }
  }
  return parent.map((_, t) => root(t));
}
