// SPDX-License-Identifier: MIT
// The tools of `meshrepair mcp`: what a client may ask for, and the words of the programs that this becomes. Only options that a schema
// names reach a program, in the form --name=value; paths are absolute.
import {Refused, claimsOf} from './mcp-folders.js';

const MOST_IN_A_LIST = 20;  // of a report
const OF_NO_USE = ['command', 'report_version', 'stages', 'peak_memory_bytes', 'picture'];
const EXIT_CODES = {
  1: 'the result is written, but a guarantee does not hold', 2: 'an argument is wrong', 3: 'an input cannot be read',
  4: 'a limit was reached', 5: 'the input encloses nothing: thicken makes solids of open sheets',
  6: 'the output cannot be written', 70: 'a bug of the program',
};

const text = (description, more = {}) => ({type: 'string', description, ...more});
const oneOf = (description, ...names) => text(description, {enum: names});
const flag = (description) => ({type: 'boolean', description});
const PATH = {maxLength: 4096, pattern: '^[^\\u0000-\\u001f]+$'};
const pathOf = (what) => text(`${what}: an absolute path, or one relative to the first folder`, PATH);
const number = (type, description, minimum, pattern) => ({type: ['string', type], description, minimum, pattern: `^(${pattern})$`});
const NUMBER = '[0-9]+([.][0-9]*)?([eE]-?[0-9]+)?%?';
const length = (what, ...words) => {
  const description = [`${what} In units of the mesh, or as a share of its diagonal, such as "1%"`, ...words].join(', or ');
  return number('number', description, 0, [...words, NUMBER].join('|'));
};
const MESH = pathOf('Mesh (STL, OBJ, OFF, PLY, glTF, 3MF)');
const WRITTEN = {
  output: pathOf('File to write; its extension (.stl .obj .off .ply .glb .gltf .3mf) is the format'),
  overwrite: flag('Replace the output if it exists. Default false'),
  picture: flag('Return a picture of inputs and result side by side, too'),
};
const READS = {readOnlyHint: true, destructiveHint: false, idempotentHint: true, openWorldHint: false};
const WRITES = {readOnlyHint: false, destructiveHint: true, idempotentHint: true, openWorldHint: false};

const schema = (required, properties) => ({type: 'object', properties, required, additionalProperties: false});
const options = (from) => Object.entries(from).filter(([, value]) => value !== undefined && value !== false)
  .map(([name, value]) => `--${name.replaceAll('_', '-')}${value === true ? '' : `=${value}`}`);
const drawn = (wanted, file) => (wanted ? ['--picture', file('picture.png')] : []);

// `words` gives the words of the command line; `done` are the exit codes of success.
export const TOOLS = [
  {
    name: 'list', title: 'List meshes', annotations: READS,
    description: 'Lists the files of meshes and point clouds in the folders of this server, with their sizes.',
    inputSchema: schema([], {folder: pathOf('Folder to list; all by default')}),
  },
  {
    name: 'check', title: 'Check a mesh', annotations: READS, program: 'meshcheck', done: [0, 1],
    description: 'Tells whether a mesh is the boundary of a solid, and counts its defects (open edges, intersections, flipped triangles) ' +
        'with their places, parts, volume and area. All answers are exact. Changes nothing.',
    inputSchema: schema(['mesh'], {
      mesh: MESH,
      places: {type: 'integer', description: 'How many places of each defect to return. Default 10', minimum: 0, maximum: MOST_IN_A_LIST},
      openings: flag('Look for narrow openings of much wider spaces, too, which seal of repair would close'),
      thickness: length('Look for walls, pins, gaps and sharp edges thinner than this, too.'),
    }),
    words: ({mesh, ...set}, paths) => [paths.input(mesh), ...options(set)],
  },
  {
    name: 'repair', title: 'Repair a mesh', annotations: WRITES, program: 'meshrepair', done: [0],
    description: 'Turns a broken mesh, or a point cloud, into the boundary of a solid, and certifies the result: closed, manifold, ' +
        'oriented, free of self-intersections. Also simplifies (triangles, max_error). Defaults suit most meshes.',
    inputSchema: schema(['mesh', 'output'], {
      mesh: pathOf('Mesh or point cloud'),
      ...WRITTEN,
      for: oneOf('Purpose, which sets other options. print: no voids, sheets become walls', 'print', 'simulation', 'render', 'boolean'),
      holes: oneOf('How to fill holes. Default patch: curved like the surface around', 'patch', 'curved', 'flat', 'extend', 'none'),
      seal: length('Close openings narrower than this, and fill the space behind.', 'auto', 'double-walls', 'none'),
      thicken: length('Give open sheets this thickness; otherwise they are dropped.', 'auto', 'none'),
      keep: number('integer', 'Solids to keep: all (default), outer, largest, or this many', 1, 'all|outer|largest|[1-9][0-9]*'),
      cavities: oneOf('fill: no closed voids in the result. Default keep', 'keep', 'fill'),
      inside: oneOf('Rule that decides what is solid. Default auto', 'auto', 'winding', 'solidity', 'parity'),
      base: flag('Close an open terrain or scan with walls and a floor below'),
      triangles: number('integer', 'Simplify to this many triangles, or to a share of them, such as "10%"', 4, '[0-9]+([.][0-9]+)?%?'),
      max_error: length('Simplify as far as the surface stays this near, proven in both directions.'),
    }),
    words: ({mesh, output, overwrite, picture, ...set}, paths, file) =>
      [paths.input(mesh), paths.output(output, overwrite), ...options(set), ...drawn(picture, file)],
  },
  {
    name: 'boolean', title: 'Combine solids', annotations: WRITES, program: 'bspbool', done: [0],
    description: 'Unites, intersects or subtracts solids exactly, and certifies the result. Meshes that are not solids are repaired first.',
    inputSchema: schema(['operation', 'meshes', 'output'], {
      operation: oneOf('difference: the first without all others; xor: inside an odd number', 'union', 'intersection', 'difference', 'xor'),
      meshes: {type: 'array', items: MESH, minItems: 2, maxItems: 100, description: 'Meshes to combine'},
      ...WRITTEN,
    }),
    words: ({operation, meshes, output, overwrite, picture}, paths, file) =>
      [...meshes.map((mesh) => paths.input(mesh)), `--op=${operation}`, '-o', paths.output(output, overwrite), ...drawn(picture, file)],
  },
  {
    name: 'distance', title: 'Compare two meshes', annotations: READS, program: 'meshdist', done: [0],
    description: 'Measures the mean, root mean square and largest (Hausdorff) distance between two meshes in both directions.',
    inputSchema: schema(['a', 'b'], {a: MESH, b: MESH, bound: flag('Compute a proven upper bound, too, which takes longer')}),
    words: ({a, b, ...set}, paths) => [paths.input(a), paths.input(b), ...options(set)],
  },
  {
    name: 'picture', title: 'Show a mesh', annotations: READS, program: 'meshcheck', done: [0, 1],
    description: 'Draws a mesh, as PNG. Back faces are red. Several views help to understand a shape.',
    inputSchema: schema(['mesh'], {
      mesh: MESH,
      view: text('front, back, left, right, top, bottom, iso (default), or AZIMUTH,ELEVATION in degrees', {
        pattern: '^(front|back|left|right|top|bottom|iso|-?[0-9.]{1,9},-?[0-9.]{1,9})$',
      }),
      colours: oneOf('looks (default), or defects: intersecting red, open yellow, flipped blue, non-manifold orange', 'looks', 'defects'),
    }),
    words: ({mesh, view, colours}, paths, file) =>
      [paths.input(mesh), ...drawn(true, file), ...options({'picture-view': view, 'picture-colours': colours})],
  },
];

const typeOf = (value) => (value === null ? 'null' : Array.isArray(value) ? 'array' : typeof value);
const isOf = (value, type) => (type === 'integer' ? Number.isSafeInteger(value) : typeOf(value) === type && value !== Infinity);

// What of a value does not fit its schema, as a line; null: all fits.
export function complaint(value, {type, pattern, minimum, maximum, maxLength, minItems, maxItems, ...rest}, name) {
  const beyond = (size, least = -Infinity, most = Infinity) => !(size >= least && size <= most);
  const types = [type].flat();
  const wrong = `${name} is wrong: ${rest.description}`;
  if (!types.some((each) => isOf(value, each))) return `${name} must be ${types.join(' or ')}`;
  if (rest.enum && !rest.enum.includes(value)) return `${name} must be one of ${rest.enum.join(', ')}`;
  if (typeof value === 'number') return beyond(value, minimum, maximum) ? `${wrong} (${minimum} to ${maximum ?? 'any'})` : null;
  if (typeof value === 'string') return beyond(value.length, 0, maxLength) || !new RegExp(pattern).test(value) ? wrong : null;
  if (rest.items) {
    if (beyond(value.length, minItems, maxItems)) return `${name} must have ${minItems} to ${maxItems} entries`;
    return value.map((item, i) => complaint(item, rest.items, `${name}[${i}]`)).find(Boolean) ?? null;
  }
  const {properties, required = []} = rest;
  if (!properties) return null;
  const unknown = Object.keys(value).find((key) => !Object.hasOwn(properties, key));
  if (unknown !== undefined) return `there is no argument ${unknown}; there are ${Object.keys(properties).join(', ')}`;
  const missing = required.find((key) => !Object.hasOwn(value, key));
  if (missing) return `${missing} is missing`;
  return Object.keys(value).map((key) => complaint(value[key], properties[key], key)).find(Boolean) ?? null;
}

// The report without what is of no use here, and with long lists cut; notes what was left out.
function shortened(report) {
  const leftOut = new Set(OF_NO_USE.filter((key) => key in report));
  const cut = (value, name) => {
    if (Array.isArray(value)) {
      if (value.length > MOST_IN_A_LIST) leftOut.add(`${name}: ${value.length - MOST_IN_A_LIST} of ${value.length}`);
      return value.slice(0, MOST_IN_A_LIST).map((each) => cut(each, name));
    }
    if (typeOf(value) !== 'object') return value;
    const kept = Object.entries(value).filter(([key]) => name || !OF_NO_USE.includes(key));
    return Object.fromEntries(kept.map(([key, inner]) => [key, cut(inner, name ? `${name}.${key}` : key)]));
  };
  return {report: cut(report, ''), left_out: [...leftOut]};
}

function resultOf(tool, {code, output, report, picture}, timeLimit) {
  const isError = !tool.done.includes(code);
  const end = code === null ? `it crashed, or went beyond the time limit of ${timeLimit} s` : EXIT_CODES[code] ?? `exit code ${code}`;
  const summary = isError ? `${output}\n(${end})`.trim() : output;
  const content = [{type: 'text', text: summary}];
  if (picture) content.push({type: 'image', data: picture, mimeType: 'image/png'});
  if (!report || tool.name === 'picture') return {content, isError};
  const short = shortened(report);
  content.push({type: 'text', text: JSON.stringify(short)});
  return {content, structuredContent: {summary, ...short}, isError};
}

function listed(folders, {folder}) {
  const {files, isWhole} = folders.list(folder === undefined ? undefined : folders.folder(folder));
  const lines = files.map(({path, bytes}) => `${path}  ${bytes} bytes`);
  if (files.length === 0) lines.push('There are no meshes.');
  if (!isWhole) lines.push('There are more: name a folder.');
  const structuredContent = {folders: folders.folders, files, is_whole: isWhole};
  return {content: [{type: 'text', text: lines.join('\n')}], structuredContent, isError: false};
}

// What the tool answers. What is refused is a result, too, which the assistant reads.
export async function call(tool, from, {folders, runs, maxFile, signal, progress}) {
  const written = [];
  const paths = {
    input: (text) => folders.input(text, maxFile),
    output: (text, overwrite) => {
      const target = folders.output(text, overwrite === true);
      written.push(...claimsOf(target));
      written.forEach((name) => folders.claimed.add(name));
      return target;
    },
  };
  try {
    if (!tool.program) return listed(folders, from);
    const done = await runs.run(tool.program, (file) => tool.words(from, paths, file), {signal, progress});
    return resultOf(tool, done, runs.timeLimit);
  } catch (error) {
    if (!(error instanceof Refused) && !error.syscall) throw error;
    return {content: [{type: 'text', text: error.message}], isError: true};
  } finally {
    written.forEach((name) => folders.claimed.delete(name));
  }
}
