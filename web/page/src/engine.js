// SPDX-License-Identifier: MIT
// What checks and repairs for the page: the package, in a worker of this browser. Another engine may take its place, a server say, that
// has the same three functions.
//
//   check(progress)            to {isGood, message, warnings, page}
//   repair(options, progress)  to {isGood, message, warnings, page, files: [{name, bytes}]}
//   cancel()                   the one that runs is rejected with an AbortError
//
// `page` is the page of --html as bytes. Both throw where the mesh cannot be read or makes no solid; the message is for the user.

import {check, repair} from 'meshrepair';

export class PackageEngine {
  // `file` is the mesh, `others` are the files beside it.
  constructor(file, others) {
    this.file = file;
    this.others = Object.fromEntries(others.map((other) => [other.name, other]));
    this.running = null;
  }

  async check(progress) {
    const {valid, warnings, html} = await this.run((more) => check(this.file, {html: true, ...more}), progress);
    const message = valid ? 'The mesh is a valid solid already.' : 'The mesh is not a valid solid.';
    return {isGood: valid, message, warnings, page: html};
  }

  async repair(options, progress) {
    const made = await this.run((more) => repair(this.file, {html: true, ...options, ...more}), progress);
    const name = `${this.file.name.replace(/(\.(gz|zst|zip))$/i, '').replace(/\.[^.]*$/, '')}_repaired`;
    const files = [{name: `${name}.${options.to}`, bytes: await made.bytes()}];
    for (const [other, bytes] of Object.entries(made.files)) files.push({name: other, bytes});
    const message = made.certified ? 'Repaired: a valid solid, certified.' : `Repaired, but ${made.error.replace(/^error: /, '')}.`;
    return {isGood: made.certified, message, warnings: made.warnings, page: made.html, files};
  }

  cancel() {
    this.running?.abort();
  }

  async run(call, progress) {
    this.cancel();
    const running = this.running = new AbortController();
    try {
      return await call({files: this.others, progress, signal: running.signal});
    } finally {
      if (this.running === running) this.running = null;
    }
  }
}
