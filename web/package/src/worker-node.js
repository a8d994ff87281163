// SPDX-License-Identifier: MIT
// The worker of node.
import {webcrypto} from 'node:crypto';
import {parentPort} from 'node:worker_threads';

globalThis.crypto ??= webcrypto;  // names of temporary files
const {serve} = await import('./serve.js');

serve({
  post: (message, buffers) => parentPort.postMessage(message, buffers),
  listen: (heard) => parentPort.on('message', heard),
});
