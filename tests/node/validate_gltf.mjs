// SPDX-License-Identifier: MIT
// Runs Khronos' glTF validator on all files of a folder, in one process.
//
// Usage: node validate_gltf.mjs FOLDER
//
// Prints a line for each error, and how many files there were. Exit code 0: no errors, 1: some, 77: the
// validator is not installed (scripts/setup.sh all does that).

import {readdir, readFile} from 'node:fs/promises';
import path from 'node:path';

const folder = process.argv[2];
let validator;
try {
  validator = (await import('gltf-validator')).default;
} catch (error) {
  console.log(`the validator is not installed: ${error.code}`);
  process.exit(77);
}

const names = (await readdir(folder)).filter((name) => /\.gl(b|tf)$/.test(name)).sort();
let errors = 0;
for (const name of names) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(path.join(folder, name))), {
    uri: name,
    maxIssues: 0,  // no limit
    externalResourceFunction: async (uri) =>
        new Uint8Array(await readFile(path.join(folder, decodeURIComponent(uri)))),
  });
  errors += report.issues.numErrors;
  for (const issue of report.issues.messages.filter(({severity}) => severity === 0)) {
    console.log(`${name}: ${issue.code} at ${issue.pointer}: ${issue.message}`);
  }
}
console.log(`${names.length} files, ${errors} errors`);
process.exit(errors === 0 ? 0 : 1);
