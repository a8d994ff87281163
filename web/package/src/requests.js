// SPDX-License-Identifier: MIT
// What callers give, as requests for the worker: plain data, checked as far as types go. What options there are, the module knows.

import {usage} from './errors.js';

// What is written, and under which names files are known.
export const formats = ['stl', 'obj', 'off', 'ply', 'glb', 'gltf', '3mf'];

const NOT_OPTIONS = new Set(['progress', 'signal', 'to', 'from', 'files', 'html']);

// Options by the programs' long names: maxHole, max_hole and "max-hole" are one.
export function programOptions(options) {
  const chosen = {};
  for (const [name, value] of Object.entries(options)) {
    if (NOT_OPTIONS.has(name) || value === undefined || value === null || value === false) continue;
    if (!['string', 'number', 'boolean'].includes(typeof value)) throw usage(`${name}: needs a word, a number, true or false`);
    chosen[name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`).replaceAll('_', '-')] = value;
  }
  return chosen;
}

// "stl" or "part.stl.gz" to the name of a file.
export function fileName(format, otherwise) {
  if (format === undefined) return otherwise;
  if (typeof format !== 'string' || format === '') throw usage('to: needs the name of a format');
  const name = format.includes('.') && !/^[a-z0-9]+\.(gz|zst)$/i.test(format) ? format : `mesh.${format}`;
  return plainName(name);
}

export function isMesh(input) {
  return typeof input === 'object' && input !== null && 'vertices' in input && 'faces' in input;
}

export function meshOf({vertices, faces, attributes}) {
  const isReal = vertices instanceof Float64Array || vertices instanceof Float32Array || Array.isArray(vertices);
  if (!isReal || vertices.length % 3 !== 0) throw usage('vertices: are to be a Float64Array or Float32Array of x, y, z');
  const isWhole = faces instanceof Uint32Array || faces instanceof Int32Array || faces instanceof Uint16Array || Array.isArray(faces);
  if (!isWhole || faces.length % 3 !== 0) throw usage('faces: are to be a Uint32Array of three numbers of vertices each');
  const given = attributes?.map(({name, components, values, corners}) => ({name, components, values, corners}));
  if (given?.some(({corners}) => corners.length !== faces.length)) throw usage('attributes: need a number for each corner');
  return {vertices, faces, attributes: given};
}

// Bytes of a file, and of those beside it: {name, files}.
export async function filesOf(input, {from, files = {}}) {
  const name = from === undefined ? plainName(input?.name ?? 'mesh') : fileName(from);
  const all = {};
  for (const [key, bytes] of Object.entries(files)) all[plainPath(key)] = await bytesOf(bytes);
  all[name] = await bytesOf(input);
  return {name, files: all};
}

async function bytesOf(input) {
  if (input instanceof Uint8Array) return input;
  if (input instanceof ArrayBuffer) return new Uint8Array(input);
  if (ArrayBuffer.isView(input)) return new Uint8Array(input.buffer, input.byteOffset, input.byteLength);
  if (typeof Blob === 'function' && input instanceof Blob) return new Uint8Array(await input.arrayBuffer());
  throw usage('the input is neither bytes of a file nor {vertices, faces}');
}

// Names that lead nowhere else.
function plainName(name) {
  const plain = String(name).replace(/^.*[/\\]/, '').replaceAll('\0', '');
  if (plain === '' || plain === '.' || plain === '..' || plain === '-') return 'mesh';
  return plain;
}

function plainPath(path) {
  return String(path).split(/[/\\]/).filter((part) => part !== '' && part !== '.' && part !== '..').join('/') || 'file';
}
