// SPDX-License-Identifier: MIT
// The calls, as the worker does them: each takes a request, plain data, and gives an answer, plain data, too.

// Frees what was made for a call, whatever becomes of it.
function using(made, free, use) {
  try {
    return use(made);
  } finally {
    free(made);
  }
}

function failure(message, code = 2) {
  return {code, error: message, report: null, warnings: []};
}

export class Calls {
  constructor(module) {
    this.module = module;
    this.c = module.it;
  }

  // `tell` gets {stage, share}.
  run(request, tell) {
    this.module.told = tell;
    try {
      return this[request.call](request);
    } finally {
      this.module.told = null;
    }
  }

  repair(request) {
    if (request.files) return this.repairFile(request);
    return this.withMesh(request.mesh, (mesh) => this.withResult(
        (options) => this.c._meshrepair_repair(mesh, options), request.options,
        (result) => this.madeMesh(result, request)));
  }

  // From file to file, as the program does it; what the file holds comes back as arrays, too.
  repairFile({name, files, output, options, html}) {
    this.module.putFiles(files);
    const more = html ? {...options, html: this.module.outputPath('page.html')} : options;
    const answer = this.withNames(name, this.module.outputPath(output), (from, to) => this.withResult(
        (handle) => this.c._meshrepair_repair_file(from, to, handle), more, (result) => this.module.outcomeOf(result)));
    if (answer.code > 1) return answer;
    const mesh = this.readPath(this.module.outputPath(output), {}, false);
    const written = this.written(output);
    return {...answer, vertices: mesh.vertices, faces: mesh.faces, ...written};
  }

  check(request) {
    const {mesh, options} = request;
    if (request.files) return this.checkFile(request);
    return this.withMesh(mesh, (handle) => this.withResult(
        (set) => this.c._meshrepair_check(handle, set), options, (result) => {
          const marks = this.module.uint16(this.c._meshrepair_result_marks(result), mesh.faces.length / 3);
          return {...this.module.outcomeOf(result), marks, defects: this.defectNames()};
        }));
  }

  checkFile({name, files, options, html}) {
    this.module.putFiles(files);
    const more = html ? {...options, html: this.module.outputPath('page.html')} : options;
    const answer = this.withNames(name, '', (from) => this.withResult(
        (handle) => this.c._meshrepair_check_file(from, handle), more, (result) => this.module.outcomeOf(result)));
    return {...answer, html: this.written('').html};
  }

  boolean({operands, options, ...request}) {
    const handles = [];
    try {
      for (const operand of operands) {
        const mesh = operand.files ? this.handleOfFile(operand) : this.handleOf(operand);
        if (mesh.error !== undefined) return mesh;
        handles.push(mesh);
      }
      return this.module.withMemory(4 * handles.length, (list) => {
        this.c.HEAPU32.set(handles, list >>> 2);
        return this.withResult((set) => this.c._meshrepair_boolean(list, handles.length, set), options,
            (result) => this.madeMesh(result, request));
      });
    } finally {
      for (const handle of handles) this.c._meshrepair_mesh_free(handle);
    }
  }

  read({name, files, options}) {
    this.module.putFiles(files);
    const answer = this.readPath(name, options, true);
    this.module.clearFiles();
    return answer;
  }

  write({mesh, output, options}) {
    this.module.clearFiles();
    return this.withMesh(mesh, (handle) => this.writeHandle(handle, output, options));
  }

  // ---- What the calls share ----

  withNames(from, to, use) {
    return this.module.withText(from, (a) => this.module.withText(to, (b) => use(a, b)));
  }

  withResult(call, options, use) {
    return this.module.withOptions(options, (handle) => using(call(handle), (it) => this.c._meshrepair_result_free(it), use));
  }

  // A handle, or a failure.
  handleOf({vertices, faces, attributes = []}) {
    const handle = this.module.newMesh(vertices, faces);
    if (handle === 0) return failure(this.module.lastError());
    for (const attribute of attributes) {
      const code = this.module.addAttribute(handle, attribute);
      if (code === 0) continue;
      const answer = failure(this.module.lastError(), code);
      this.c._meshrepair_mesh_free(handle);
      return answer;
    }
    return handle;
  }

  handleOfFile({name, files}) {
    this.module.putFiles(files);
    return this.withNames(name, '', (from) => this.withResult((set) => this.c._meshrepair_read(from, set), {}, (result) => {
      const taken = this.c._meshrepair_result_take_mesh(result);
      return taken === 0 ? this.module.outcomeOf(result) : taken;
    }));
  }

  withMesh(mesh, use) {
    const handle = this.handleOf(mesh);
    if (handle.error !== undefined) return handle;
    return using(handle, (it) => this.c._meshrepair_mesh_free(it), use);
  }

  // The mesh of a result, and the bytes of a file with it where one is wanted.
  madeMesh(result, {output, asFloat32}) {
    const answer = this.module.outcomeOf(result);
    const mesh = this.c._meshrepair_result_mesh(result);
    if (mesh === 0) return answer;
    const arrays = this.module.arraysOf(mesh, asFloat32);
    const sources = this.module.uint32(this.c._meshrepair_result_sources(result), arrays.faces.length / 3);
    if (!output) return {...answer, ...arrays, sources};
    this.module.clearFiles();
    const file = this.writeHandle(mesh, output, {});
    if (file.code !== 0) return file;
    return {...answer, ...arrays, sources, bytes: file.bytes, files: file.files, warnings: [...answer.warnings, ...file.warnings]};
  }

  writeHandle(mesh, output, options) {
    const answer = this.withNames(this.module.outputPath(output), '', (to) => this.withResult(
        (set) => this.c._meshrepair_write(to, mesh, set), options, (result) => this.module.outcomeOf(result)));
    return answer.code === 0 ? {...answer, ...this.written(output)} : answer;
  }

  readPath(path, options, whole) {
    return this.withNames(path, '', (from) => this.withResult((set) => this.c._meshrepair_read(from, set), options, (result) => {
      const answer = this.module.outcomeOf(result);
      const mesh = this.c._meshrepair_result_mesh(result);
      if (mesh === 0) return answer;
      const arrays = this.module.arraysOf(mesh, false);
      return whole ? {...answer, ...arrays} : arrays;
    }));
  }

  // What stands in the folder of what was written: the file of this name, a page, and those beside.
  written(output) {
    const {[output]: bytes, 'page.html': html, ...files} = this.module.takeFiles();
    return {bytes, files, html};
  }

  defectNames() {
    const names = [];
    for (let bit = 0; ; ++bit) {
      const name = this.c._meshrepair_defect_name(bit);
      if (name === 0) return names;
      names.push(this.c.UTF8ToString(name));
    }
  }
}
