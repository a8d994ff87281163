// SPDX-License-Identifier: MIT
// Workers: one for each call at a time. One that is done waits for the next call, unless it has taken much memory, which a module never
// gives back. To cancel is to terminate.

const MOST_BYTES_AT_REST = 256 << 20;

export class Pool {
  // `platform`: startWorker() and compile().
  constructor(platform) {
    this.platform = platform;
    this.idle = null;
    this.compiling = null;
  }

  compiled() {
    this.compiling ??= this.platform.compile().catch((error) => {
      this.compiling = null;  // a network may come back
      throw error;
    });
    return this.compiling;
  }

  take() {
    const worker = this.idle ?? {port: this.platform.startWorker(), heard: null, failed: null};
    if (this.idle === null) worker.port.listen((message) => worker.heard?.(message), (what) => worker.failed?.(what));
    this.idle = null;
    worker.port.wake();
    return worker;
  }

  putBack(worker, bytesOfMemory) {
    worker.heard = worker.failed = null;
    if (this.idle !== null || bytesOfMemory > MOST_BYTES_AT_REST) return worker.port.terminate();
    this.idle = worker;
    worker.port.rest();
  }

  // The answer to a request. Rejects with the reason of `signal` where it is aborted.
  async run(request, {progress, signal}) {
    signal?.throwIfAborted();
    const compiled = await this.compiled();
    signal?.throwIfAborted();
    const worker = this.take();
    return new Promise((resolve, reject) => {
      const stop = () => {
        end();
        worker.port.terminate();
        reject(signal.reason);
      };
      const end = () => {
        worker.heard = worker.failed = null;
        signal?.removeEventListener('abort', stop);
      };
      signal?.addEventListener('abort', stop);
      worker.failed = (what) => {
        end();
        worker.port.terminate();
        resolve({code: 70, error: `the worker stopped: ${what}`, report: null, warnings: []});
      };
      worker.heard = (message) => {
        if (message.progress) return progress?.(message.progress);
        end();
        if (message.isWell) {
          this.putBack(worker, message.bytesOfMemory);
        } else {
          worker.port.terminate();
        }
        resolve(message.answer);
      };
      worker.port.post({compiled, request});
    });
  }
}
