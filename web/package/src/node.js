// SPDX-License-Identifier: MIT
// meshrepair for node.
import {readFile} from 'node:fs/promises';
import {Worker} from 'node:worker_threads';
import {makeApi} from './api.js';

const STACK_MEGABYTES = 32;  // the work calls itself, deeper than scripts do

function startWorker() {
  const worker = new Worker(new URL('./worker-node.js', import.meta.url), {resourceLimits: {stackSizeMb: STACK_MEGABYTES}});
  return {
    post: (message) => worker.postMessage(message),
    listen: (heard, failed) => {
      worker.on('message', heard);
      worker.on('error', (error) => failed(error.message));
    },
    terminate: () => worker.terminate(),
    rest: () => worker.unref(),  // a process may end while it waits for work
    wake: () => worker.ref(),
  };
}

const compile = async () => WebAssembly.compile(await readFile(new URL('./meshrepair.wasm', import.meta.url)));

export const {repair, check, boolean, read, write, formats} = makeApi({startWorker, compile});
export {MeshRepairError} from './errors.js';
