// SPDX-License-Identifier: MIT
// The C interface of meshrepair as functions of JavaScript: strings, arrays and files go in and out of the memory of the module.

import createModule from './meshrepair.mjs';

const IN = '/work/in';
const OUT = '/work/out';

export class Module {
  // `compiled`: a WebAssembly.Module of meshrepair.wasm.
  static async start(compiled) {
    const it = await createModule({
      instantiateWasm(imports, done) {
        WebAssembly.instantiate(compiled, imports).then((instance) => done(instance));
        return {};
      },
      print() {},
      printErr() {},
    });
    return new Module(it);
  }

  constructor(it) {
    this.it = it;
    this.told = null;
    this.tell = it.addFunction((data, stage, share) => {
      this.told?.({stage: it.UTF8ToString(stage), share});
      return 0;
    }, 'iiid');
    it.FS.mkdirTree(IN);
    it.FS.mkdirTree(OUT);
    it.FS.chdir(IN);
  }

  bytesOfMemory() {
    return this.it.HEAPU8.length;
  }

  // What C is given for the time of `use`: a string that ends with a zero.
  withText(text, use) {
    const length = this.it.lengthBytesUTF8(text) + 1;
    return this.withMemory(length, (at) => {
      this.it.stringToUTF8(text, at, length);
      return use(at);
    });
  }

  withMemory(bytes, use) {
    const at = this.it._malloc(Math.max(1, bytes));
    if (at === 0) throw new RangeError('out of memory');
    try {
      return use(at);
    } finally {
      this.it._free(at);
    }
  }

  withOptions(options, use) {
    const handle = this.it._meshrepair_options_new();
    try {
      for (const [name, value] of Object.entries(options)) {
        this.withText(name, (at) => {
          if (value === true) return this.it._meshrepair_options_set(handle, at, 0);
          return this.withText(String(value), (text) => this.it._meshrepair_options_set(handle, at, text));
        });
      }
      this.it._meshrepair_options_set_progress(handle, this.tell, 0);
      return use(handle);
    } finally {
      this.it._meshrepair_options_free(handle);
    }
  }

  // A handle of vertices and faces; 0 and why where they are none.
  newMesh(vertices, faces) {
    return this.withMemory(vertices.length * 8, (points) => this.withMemory(faces.length * 4, (corners) => {
      this.it.HEAPF64.set(vertices, points >>> 3);
      this.it.HEAPU32.set(faces, corners >>> 2);
      return this.it._meshrepair_mesh_new(points, vertices.length / 3, corners, faces.length / 3);
    }));
  }

  lastError() {
    return this.it.UTF8ToString(this.it._meshrepair_last_error());
  }

  // Copies of what a mesh has.
  arraysOf(mesh, asFloat32) {
    const points = 3 * this.it._meshrepair_mesh_vertex_count(mesh);
    const corners = 3 * this.it._meshrepair_mesh_triangle_count(mesh);
    const coordinates = this.float64(this.it._meshrepair_mesh_vertices(mesh), points);
    return {
      vertices: asFloat32 ? Float32Array.from(coordinates) : coordinates,
      faces: this.uint32(this.it._meshrepair_mesh_triangles(mesh), corners),
      attributes: this.attributesOf(mesh, corners),
    };
  }

  attributesOf(mesh, corners) {
    const list = [];
    for (let i = 0; i < this.it._meshrepair_mesh_attribute_count(mesh); ++i) {
      const components = this.it._meshrepair_mesh_attribute_components(mesh, i);
      const count = this.it._meshrepair_mesh_attribute_value_count(mesh, i);
      list.push({
        name: this.it.UTF8ToString(this.it._meshrepair_mesh_attribute_name(mesh, i)),
        components,
        values: this.float64(this.it._meshrepair_mesh_attribute_values(mesh, i), components * count),
        corners: this.uint32(this.it._meshrepair_mesh_attribute_corners(mesh, i), corners),
      });
    }
    return list;
  }

  addAttribute(mesh, {name, components, values, corners}) {
    return this.withText(name, (text) => this.withMemory(values.length * 8, (numbers) => this.withMemory(corners.length * 4, (of) => {
      this.it.HEAPF64.set(values, numbers >>> 3);
      this.it.HEAPU32.set(corners, of >>> 2);
      return this.it._meshrepair_mesh_add_attribute(mesh, text, components, numbers, values.length / components, of);
    })));
  }

  float64(at, count) {
    return count === 0 ? new Float64Array() : this.it.HEAPF64.slice(at >>> 3, (at >>> 3) + count);
  }

  uint32(at, count) {
    return count === 0 || at === 0 ? new Uint32Array() : this.it.HEAPU32.slice(at >>> 2, (at >>> 2) + count);
  }

  uint16(at, count) {
    return count === 0 || at === 0 ? new Uint16Array() : this.it.HEAPU16.slice(at >>> 1, (at >>> 1) + count);
  }

  // What a result says of itself.
  outcomeOf(result) {
    const text = (at) => (at === 0 ? '' : this.it.UTF8ToString(at).replaceAll(`${OUT}/`, ''));
    const report = text(this.it._meshrepair_result_report(result));
    const warnings = [];
    for (let i = 0; i < this.it._meshrepair_result_warning_count(result); ++i) {
      warnings.push(text(this.it._meshrepair_result_warning(result, i)));
    }
    return {
      code: this.it._meshrepair_result_code(result),
      error: text(this.it._meshrepair_result_error(result)),
      report: report === '' ? null : JSON.parse(report),
      warnings,
    };
  }

  // Files that come in, by their names, and the paths of those that go out. Both folders are emptied first.
  putFiles(files) {
    this.clearFiles();
    for (const [name, bytes] of Object.entries(files)) {
      const path = `${IN}/${name}`;
      this.it.FS.mkdirTree(path.slice(0, path.lastIndexOf('/')));
      this.it.FS.writeFile(path, bytes, {canOwn: true});
    }
  }

  outputPath(name) {
    return `${OUT}/${name}`;
  }

  // All that was written, by name.
  takeFiles() {
    const files = {};
    const walk = (folder) => {
      for (const name of this.it.FS.readdir(`${OUT}/${folder}`)) {
        if (name === '.' || name === '..') continue;
        const path = `${folder}${name}`;
        if (this.it.FS.isDir(this.it.FS.stat(`${OUT}/${path}`).mode)) {
          walk(`${path}/`);
        } else {
          files[path] = this.it.FS.readFile(`${OUT}/${path}`);
        }
      }
    };
    walk('');
    this.clearFiles();
    return files;
  }

  clearFiles() {
    const clear = (folder) => {
      for (const name of this.it.FS.readdir(folder)) {
        if (name === '.' || name === '..') continue;
        const path = `${folder}/${name}`;
        if (this.it.FS.isDir(this.it.FS.stat(path).mode)) {
          clear(path);
          this.it.FS.rmdir(path);
        } else {
          this.it.FS.unlink(path);
        }
      }
    };
    clear(IN);
    clear(OUT);
  }
}
