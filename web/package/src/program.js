// SPDX-License-Identifier: MIT
// Runs a program of the package with the words of the command line: the main thread of node. The program runs in a worker, whose stack is
// large, and which leaves this thread free for signals, and for standard input, since a worker that waits for that cannot be ended.
import {readFileSync, unlinkSync, writeSync} from 'node:fs';
import {isatty} from 'node:tty';
import v8 from 'node:v8';
import {Worker, receiveMessageOnPort, MessageChannel} from 'node:worker_threads';

const STACK_MEGABYTES = 32;  // the work calls itself, deeper than scripts do
const MILLISECONDS_TO_STOP = 750;  // as the programs have
const MILLISECONDS_OF_ONE_REQUEST = 200;  // npx passes on what the terminal has sent to all
const EXIT_LIMIT = 4;
const EXIT_INTERNAL = 70;
const SIGNALS = {SIGHUP: [1, 'hung up'], SIGINT: [2, 'interrupted'], SIGTERM: [15, 'terminated']};

function say(line) {
  try {
    writeSync(2, line);
  } catch {
    // Nobody listens.
  }
}

// To ask what is no terminal would make it a stream of node.
const columnsOf = (from, name, descriptor) => (isatty(descriptor) ? from[name].columns ?? 0 : 0);

// What the worker is sent of standard input, when it asks for some.
class StandardInput {
  constructor(send) {
    this.send = send;
  }

  open() {
    this.stream = process.stdin;
    this.stream.on('data', (bytes) => {
      this.stream.pause();
      this.send({bytes});
    });
    this.stream.on('end', () => this.send({end: true}));
    this.stream.on('error', ({code}) => this.send({error: code ?? 'EIO'}));
  }

  more() {
    if (!this.stream) this.open();
    this.stream.resume();
  }
}

export async function run(name) {
  if (name === 'meshrepair' && process.argv[2] === 'mcp') return (await import('./mcp.js')).serve(process.argv.slice(3));
  runProgram(name);
}

function runProgram(name) {
  const {port1: port, port2: theirs} = new MessageChannel();
  const shared = new Int32Array(new SharedArrayBuffer(8));  // the number of the signal; how often the worker was woken
  const wake = () => {
    Atomics.add(shared, 1, 1);
    Atomics.notify(shared, 1);
  };
  const send = (message) => {
    port.postMessage(message);
    wake();
  };
  const input = new StandardInput(send);
  const worker = new Worker(new URL('./program-worker.js', import.meta.url), {
    workerData: {
      words: [name, ...process.argv.slice(2)],
      columns: {1: columnsOf(process, 'stdout', 1), 2: columnsOf(process, 'stderr', 2)},
      shared,
      port: theirs,
    },
    transferList: [theirs],
    resourceLimits: {stackSizeMb: STACK_MEGABYTES},
  });
  let unfinished = null;
  const hear = (message) => {
    if (message.unfinished !== undefined) unfinished = message.unfinished;
    if (message.input) input.more();
    if (message.code !== undefined) process.exit(message.code);
  };
  port.on('message', hear);
  // The file that it was writing goes.
  const clear = () => {
    for (let next; (next = receiveMessageOnPort(port));) hear(next.message);
    if (unfinished === null) return;
    try {
      unlinkSync(unfinished);
    } catch {
      // It is gone.
    }
  };
  const fail = (message, code = EXIT_INTERNAL) => {
    clear();
    say(`${name}: ${message}\n`);
    process.exit(code);
  };
  worker.on('error', (error) => {
    const isMemory = error.code === 'ERR_WORKER_OUT_OF_MEMORY' || (error.name === 'RangeError' && !/call stack/.test(error.message));
    if (isMemory) fail('out of memory', EXIT_LIMIT);
    fail(`the module stopped: ${error.message}`);
  });
  worker.on('exit', () => fail('the worker of the program ended'));

  // What the worker waits for in the system, no thread can end: so the signal itself ends the process.
  const end = (signal) => {
    clear();
    if (process.platform === 'win32') process.exit(128 + SIGNALS[signal][0]);
    process.removeAllListeners(signal);
    process.kill(process.pid, signal);
  };
  let asked = -Infinity;
  for (const [signal, [number, words]] of Object.entries(SIGNALS)) {
    process.on(signal, () => {
      const since = performance.now() - asked;
      if (since < MILLISECONDS_OF_ONE_REQUEST) return;
      if (Atomics.compareExchange(shared, 0, 0, number) !== 0) end(signal);
      asked = performance.now();
      wake();
      setTimeout(() => {
        say(`${name}: ${words}\n`);
        end(signal);
      }, MILLISECONDS_TO_STOP);
    });
  }

  v8.setFlagsFromString('--wasm-lazy-compilation');  // the default since node 20: a program uses few of the functions
  WebAssembly.compile(readFileSync(new URL('./meshrepair.wasm', import.meta.url))).then(
      (compiled) => send({compiled}), (error) => fail(error.message));
}
