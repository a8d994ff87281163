// SPDX-License-Identifier: MIT
// The worker's side: starts the module that it is given, and answers one request after the other.

import {Calls} from './calls.js';
import {Module} from './module.js';

// At most some twenty times a second, as the module tells.
function buffersOf(answer) {
  const buffers = new Set();
  const collect = (value) => {
    if (ArrayBuffer.isView(value)) {
      if (value.buffer.byteLength > 0) buffers.add(value.buffer);
    } else if (value && typeof value === 'object') {
      Object.values(value).forEach(collect);
    }
  };
  collect({...answer, report: null});
  return [...buffers];
}

function broken(error) {
  const memory = error instanceof RangeError && !/call stack/.test(error.message);
  return memory ? {code: 4, error: 'out of memory', report: null, warnings: []} :
                  {code: 70, error: `the module stopped: ${error.message}`, report: null, warnings: []};
}

// `port`: post(message, buffers) and listen(heard).
export function serve(port) {
  let starting = null;
  port.listen(async ({compiled, request}) => {
    starting ??= Module.start(compiled).then((module) => new Calls(module));
    let answer;
    let isWell = true;
    let bytesOfMemory = 0;
    try {
      const calls = await starting;
      answer = calls.run(request, (progress) => port.post({progress}, []));
      bytesOfMemory = calls.module.bytesOfMemory();
    } catch (error) {
      answer = broken(error);
      isWell = false;
    }
    port.post({answer, isWell, bytesOfMemory}, buffersOf(answer));
  });
}
