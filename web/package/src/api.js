// SPDX-License-Identifier: MIT
// The calls of the package, for whichever platform.

import {MeshRepairError, usage} from './errors.js';
import {Pool} from './pool.js';
import {fileName, filesOf, formats, isMesh, meshOf, programOptions} from './requests.js';

const DONE = 0;
const NOT_CERTIFIED = 1;

// In the format of the input, unpacked; as STL where that is none that is written.
function nameOfOutput(input) {
  const plain = input.replace(/\.(gz|zst|zip)$/i, '');
  return formats.includes(formatOf(plain)) && plain.includes('.') ? plain : `${plain.replace(/\.[^.]*$/, '')}.stl`;
}

function formatOf(name) {
  return /([^.]*)(\.(gz|zst))?$/i.exec(name)[1].toLowerCase();
}

// What came of a repair. `write` makes bytes of another format.
class Made {
  #write;
  #format;
  #bytes;

  constructor(answer, format, write) {
    const {code, error, report, warnings, vertices, faces, attributes, sources, bytes, files = {}, html} = answer;
    Object.assign(this, {certified: code === DONE, error, report, warnings, vertices, faces, files});
    if (attributes !== undefined) this.attributes = attributes;
    if (sources !== undefined) this.sources = sources;
    if (html !== undefined) this.html = html;
    this.#bytes = bytes;
    this.#format = format;
    this.#write = write;
  }

  // Of the file that was asked for, or of this one in another format: its numbers are not certified.
  async bytes(format = this.#format) {
    if (format === undefined) throw usage('bytes(): needs the name of a format');
    if (format === this.#format && this.#bytes) return this.#bytes;
    return (await this.#write({vertices: this.vertices, faces: this.faces, attributes: this.attributes}, {to: format})).bytes;
  }
}

export function makeApi(platform) {
  const pool = new Pool(platform);

  async function run(request, options, most = DONE) {
    const answer = await pool.run(request, options);
    if (answer.code > most) throw new MeshRepairError(answer);
    return answer;
  }

  async function repair(input, options = {}) {
    const chosen = programOptions(options);
    if (isMesh(input)) return ofMesh({call: 'repair', mesh: meshOf(input)}, input.vertices instanceof Float32Array, chosen, options);
    const given = await filesOf(input, options);
    const output = fileName(options.to, nameOfOutput(given.name));
    const request = {call: 'repair', ...given, output, options: chosen, html: options.html === true};
    return new Made(await run(request, options, NOT_CERTIFIED), options.to ?? formatOf(output), write);
  }

  async function boolean(inputs, op, options = {}) {
    const operands = [];
    for (const input of inputs) operands.push(isMesh(input) ? meshOf(input) : await filesOf(input, {from: options.from}));
    const isSingle = inputs.length > 0 && inputs.every((input) => isMesh(input) && input.vertices instanceof Float32Array);
    return ofMesh({call: 'boolean', operands}, isSingle, {...programOptions(options), op}, options);
  }

  // In single precision where it came so.
  async function ofMesh(request, isSingle, chosen, options) {
    const all = {...chosen};
    if (isSingle) all.precision ??= 'float32';
    if (options.to !== undefined) all.format ??= formatOf(fileName(options.to));
    const output = options.to === undefined ? undefined : fileName(options.to);
    const answer = await run({...request, options: all, output, asFloat32: isSingle}, options, NOT_CERTIFIED);
    return new Made(answer, options.to, write);
  }

  async function check(input, options = {}) {
    const given = isMesh(input) ? {mesh: meshOf(input)} : {...await filesOf(input, options), html: options.html === true};
    const {code, ...answer} = await run({call: 'check', ...given, options: programOptions(options)}, options, NOT_CERTIFIED);
    return {valid: code === DONE, ...answer};
  }

  async function read(input, options = {}) {
    const {code, error, ...answer} = await run({call: 'read', ...await filesOf(input, options), options: programOptions(options)}, options);
    return answer;
  }

  async function write(mesh, options = {}) {
    if (!isMesh(mesh)) throw usage('the mesh is not {vertices, faces}');
    if (options.to === undefined) throw usage('to: needs the name of a format');
    const {bytes, files, report, warnings} = await run(
        {call: 'write', mesh: meshOf(mesh), output: fileName(options.to), options: programOptions(options)}, options);
    return {bytes, files, report, warnings};
  }

  return {repair, check, boolean, read, write, formats};
}
