// SPDX-License-Identifier: MIT
// meshrepair for browsers and what bundles for them.
import {makeApi} from './api.js';

function startWorker() {
  const worker = new Worker(new URL('./worker-browser.js', import.meta.url), {type: 'module'});
  return {
    post: (message) => worker.postMessage(message),
    listen: (heard, failed) => {
      worker.addEventListener('message', ({data}) => heard(data));
      worker.addEventListener('error', (event) => failed(event.message ?? 'the worker cannot be started'));
    },
    terminate: () => worker.terminate(),
    rest() {},
    wake() {},
  };
}

async function compile() {
  const answer = await fetch(new URL('./meshrepair.wasm', import.meta.url));
  if (!answer.ok) throw new Error(`meshrepair.wasm cannot be fetched: ${answer.status}`);
  // Some servers do not know the type.
  if (answer.headers.get('Content-Type') === 'application/wasm') return WebAssembly.compileStreaming(answer);
  return WebAssembly.compile(await answer.arrayBuffer());
}

export const {repair, check, boolean, read, write, formats} = makeApi({startWorker, compile});
export {MeshRepairError} from './errors.js';
