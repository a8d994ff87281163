// SPDX-License-Identifier: MIT
// Paths that a client of `meshrepair mcp` names: only files inside the folders of the command line. A path is compared as a text first,
// so that nothing outside is even asked for, and then as the system resolves it, so that no link leads out.
import fs from 'node:fs';
import path from 'node:path';

const MOST_FILES = 500;
const MOST_ENTRIES = 20000;  // that a listing looks at
const MESH_NAME = /\.(stl|obj|off|ply|glb|gltf|3mf|xyz|pts|pwn|pcd)(\.(gz|zst|zip))?$/i;
const WINDOWS_DEVICE = /:|^(con|prn|aux|nul|com\d|lpt\d)(\.|$)/i;

// What the client can mend: one line that names the path.
export class Refused extends Error {}

const isWithin = (folder, name) => {
  const way = path.relative(folder, name);
  return way !== '..' && !way.startsWith(`..${path.sep}`) && !path.isAbsolute(way);
};

// Files that an OBJ file is written with: its materials and their pictures.
function companionsOf(target) {
  const {dir, base} = path.parse(target);
  if (!/\.obj(\.|$)/i.test(base)) return [];
  const plain = (name) => name.toLowerCase().replace(/[^a-z0-9.]/g, '_');
  const stems = [base.replace(/\.obj.*$/i, ''), base.replace(/\.(gz|zst)$/i, '')].map(plain);
  const isOne = (name) => stems.some((stem) => name.startsWith(stem) && /^(\.mtl|_\d+\.\w+)$/.test(name.slice(stem.length)));
  return fs.readdirSync(dir).filter((name) => name !== base && isOne(plain(name))).map((name) => path.join(dir, name));
}

// Names that a call claims while it writes: no other call may write the same mesh, or the same materials.
export function claimsOf(target) {
  const {dir, base} = path.parse(target);
  return /\.obj(\.|$)/i.test(base) ? [target, path.join(dir, `${base.replace(/\.obj.*$/i, '').toLowerCase()}.mtl`)] : [target];
}

function entriesOf(folder) {
  try {
    return fs.readdirSync(folder, {withFileTypes: true}).sort((a, b) => (a.name < b.name ? -1 : 1));
  } catch {
    return [];  // it may not be read
  }
}

export class Folders {
  constructor(names) {
    this.folders = names.map((name) => fs.realpathSync(name));
    this.claimed = new Set();  // outputs of calls that are running
    this.known = [...new Set([...names.map((name) => path.resolve(name)), ...this.folders])];
    for (const folder of this.folders) {
      if (!fs.statSync(folder).isDirectory()) throw Object.assign(new Error('it is no folder'), {code: 'ENOTDIR', path: folder});
    }
  }

  // What is relative stands in the first folder.
  named(text) {
    return path.resolve(this.folders[0], text);
  }

  // `name` as the system resolves it; `text` is what the client calls it.
  resolved(text, kind, name = this.named(text)) {
    const outside = new Refused(`${text}: is outside the folders of this server`);
    if (!this.known.some((folder) => isWithin(folder, name))) throw outside;
    let real;
    try {
      real = fs.realpathSync(name);
    } catch (error) {
      throw new Refused(`${text}: ${error.code === 'ENOENT' ? `there is no such ${kind}` : `cannot be reached (${error.code})`}`);
    }
    if (!this.folders.some((folder) => isWithin(folder, real))) throw outside;
    return real;
  }

  input(text, mostBytes) {
    const real = this.resolved(text, 'file');
    const status = fs.lstatSync(real);
    if (!status.isFile()) throw new Refused(`${text}: is no regular file`);
    if (status.size > mostBytes) throw new Refused(`${text}: has ${status.size} bytes; this server reads at most ${mostBytes}`);
    return real;
  }

  folder(text, name) {
    const real = this.resolved(text, 'folder', name);
    if (!fs.lstatSync(real).isDirectory()) throw new Refused(`${text}: is not in a folder, or is none`);
    return real;
  }

  output(text, overwrite) {
    const name = this.named(text);
    const base = path.basename(name);
    if (this.known.includes(name) || /[/\\]$/.test(text)) throw new Refused(`${text}: is a folder`);
    if (process.platform === 'win32' && WINDOWS_DEVICE.test(base)) throw new Refused(`${text}: is a device`);
    const target = path.join(this.folder(text, path.dirname(name)), base);
    if (claimsOf(target).some((name) => this.claimed.has(name))) throw new Refused(`${text}: another call is writing it`);
    for (const each of [target, ...companionsOf(target)]) {
      const status = fs.lstatSync(each, {throwIfNoEntry: false});
      if (!status) continue;
      if (status.isSymbolicLink()) throw new Refused(`${each}: is a link, which is not followed; choose another output`);
      if (!status.isFile()) throw new Refused(`${each}: is no regular file; choose another output`);
      if (!overwrite) throw new Refused(`${each}: exists; choose another output, or set overwrite to true`);
    }
    return target;
  }

  // Meshes and points, without following links: {files: [{path, bytes}], isWhole}.
  list(start) {
    const files = [];
    const isStill = (folder) => fs.realpathSync.native(folder) === folder;  // it may have become a link meanwhile
    const waiting = start ? [start] : this.folders.filter((folder) => fs.existsSync(folder) && isStill(folder)).reverse();
    let looked = 0;
    for (let folder; (folder = waiting.pop()) !== undefined;) {
      const entries = entriesOf(folder);
      for (const entry of entries) {
        if (++looked > MOST_ENTRIES || files.length >= MOST_FILES) return {files, isWhole: false};
        const name = path.join(folder, entry.name);
        const status = entry.isFile() && MESH_NAME.test(entry.name) && fs.lstatSync(name, {throwIfNoEntry: false});
        if (status) files.push({path: name, bytes: status.size});  // not every name is text
      }
      waiting.push(...entries.filter((entry) => entry.isDirectory() && !/^\.|^node_modules$/.test(entry.name))
                       .map(({name}) => path.join(folder, name)).reverse());
    }
    return {files, isWhole: true};
  }
}
