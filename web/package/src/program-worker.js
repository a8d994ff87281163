// SPDX-License-Identifier: MIT
// The worker in which a program runs, from its first instruction to its exit code.
import {webcrypto} from 'node:crypto';
import os from 'node:os';
import {fileURLToPath} from 'node:url';
import {receiveMessageOnPort, workerData} from 'node:worker_threads';
import createModule from './meshrepair.mjs';
import {useFilesOfNode} from './program-files.js';
import {fromSystem} from './program-paths.js';

const {words, columns, shared, port} = workerData;
globalThis.crypto ??= webcrypto;  // node 18 has it in modules only

// The message of the main thread with this key; it waits.
function received(key) {
  for (;;) {
    const seen = Atomics.load(shared, 1);
    const next = receiveMessageOnPort(port);
    if (next?.message[key] !== undefined) return next.message[key];
    if (!next) Atomics.wait(shared, 1, seen);
  }
}

// Variables that C takes byte by byte.
const environment = () => Object.fromEntries(Object.entries(process.env).filter(([, value]) => /^[\x20-\x7e]*$/.test(value)));

// What libbase/src/system/wasm_process.cpp asks for.
const system = {
  requestToEnd: () => Atomics.load(shared, 0),
  cpuSeconds: () => {
    const {user, system} = process.cpuUsage();
    return (user + system) / 1e6;
  },
  freeMemory: () => os.freemem(),
  programFile: fromSystem(fileURLToPath(new URL('./meshrepair.wasm', import.meta.url))),
  columns: (descriptor) => columns[descriptor] ?? 0,
};

function start(compiled) {
  return createModule({
    system,
    instantiateWasm(imports, done) {
      const instance = new WebAssembly.Instance(compiled, imports);
      done(instance);
      return instance.exports;
    },
    preRun: [(module) => Object.assign(module.ENV, environment())],
  });
}

function newWords(module, list) {
  const at = module._malloc(4 * (list.length + 1)) >>> 0;
  list.forEach((word, i) => {
    const length = module.lengthBytesUTF8(word) + 1;
    const text = module._malloc(length) >>> 0;
    module.stringToUTF8(word, text, length);
    module.HEAPU32[(at >>> 2) + i] = text;
  });
  module.HEAPU32[(at >>> 2) + list.length] = 0;
  return at;
}

const module = await start(received('compiled'));
useFilesOfNode(module.FS, port, shared);
let code = 0;
try {
  code = module._meshrepair_run_program(words.length, newWords(module, words.map(fromSystem)));
} catch (error) {
  if (error?.name !== 'ExitStatus') throw error;
  code = error.status;
}
port.postMessage({code});
