// SPDX-License-Identifier: MIT
// The meshes of the page: packed as apps/page/pack_mesh.h says.

export function bytesOf(base64) {
  return Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
}

async function unpack(base64) {
  const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Reads numbers of seven bits a byte, the lowest first.
class Numbers {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }
  next() {
    let value = 0;
    for (let shift = 0;; shift += 7) {
      const byte = this.bytes[this.at++];
      value |= (byte & 127) << shift;
      if (byte < 128) return value >>> 0;
    }
  }
  nextSigned() {
    const value = this.next();
    return (value >>> 1) ^ -(value & 1);
  }
}

export async function numbersOf(base64) {
  return new Numbers(await unpack(base64));
}

// `facts` says how many triangles there are. Corners are numbers of points, three a triangle; places are steps of the grid, three a
// point; kinds and marks have one entry a triangle; values, if there are any, one a point.
export async function decodeMesh(base64, facts) {
  const numbers = await numbersOf(base64);
  const corners = new Uint32Array(3 * facts.shown);
  let points = 0;
  for (let i = 0; i < corners.length; ++i) {
    const back = numbers.next();
    corners[i] = back === 0 ? points++ : points - back;
  }
  const places = new Int32Array(3 * points);
  for (let axis = 0; axis < 3; ++axis) {
    let value = 0;
    for (let p = 0; p < points; ++p) places[3 * p + axis] = value += numbers.nextSigned();
  }
  const list = (length) => Uint32Array.from({length}, () => numbers.next());
  const [kinds, marks] = [list(facts.shown), list(facts.shown)];
  return {corners, places, kinds, marks, values: facts.has_values ? list(points) : null};
}

// From steps of the grid to the mesh's own units, and to the box that is drawn: its centre is 0, its largest side 2.
export class Grid {
  constructor({bits, low, half, high}) {
    this.most = 2 ** bits - 1;
    this.low = low;
    this.half = half;
    this.high = high;
    this.middle = high.map((steps) => steps / 2);
  }
  drawn(steps, axis) {
    return 2 * (steps - this.middle[axis]) / this.most;
  }
  drawnPlace(steps) {
    return steps.map((s, axis) => this.drawn(s, axis));
  }
  own(drawn, axis) {
    return this.low[axis] + (drawn / 2 * this.most + this.middle[axis]) / this.most * this.half * 2;
  }
  length(drawn) {
    return drawn * this.half;
  }
}
