// SPDX-License-Identifier: MIT
// Runs of programs for `meshrepair mcp`: each call is a process of its own, so that a crash, a limit or a cancellation costs no other call.
import {spawn} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

const MILLISECONDS_TO_STOP = 3000;  // a program has 750 of its own
const MILLISECONDS_BEYOND_LIMIT = 5000;
const MILLISECONDS_BETWEEN_PROGRESS = 200;
const MOST_OUTPUT = 64 * 1024;

function commandOf(program) {
  const native = process.env.MESHREPAIR_PROGRAMS;
  if (native) return [path.join(native, program)];
  return [process.execPath, fileURLToPath(new URL(`./bin/${program}.js`, import.meta.url))];
}

function stop(child) {
  child.kill('SIGTERM');
  setTimeout(() => child.kill('SIGKILL'), MILLISECONDS_TO_STOP).unref();
}

// Lines "STAGE PERCENT". What is told counts up, since each stage starts at 0.
function watch(stream, progress) {
  let [rest, count, last] = ['', 0, -Infinity];
  stream.setEncoding('latin1');
  stream.on('data', (text) => {
    const lines = (rest + text).split('\n');
    rest = lines.pop();
    if (lines.length === 0 || performance.now() - last < MILLISECONDS_BETWEEN_PROGRESS) return;
    last = performance.now();
    progress(++count, `${lines.at(-1)} %`);
  });
}

function collected(stream) {
  const said = {text: ''};
  stream.setEncoding('utf8');
  stream.on('data', (text) => {
    if (said.text.length < MOST_OUTPUT) said.text += text;
  });
  return said;
}

export class Runs {
  constructor({jobs, timeLimit, maxMemory}) {
    this.free = jobs;
    this.waiting = [];
    this.timeLimit = timeLimit;
    this.limits = ['--time-limit', String(timeLimit), ...(maxMemory ? ['--max-memory', maxMemory] : [])];
  }

  // Waits until fewer than `jobs` programs run.
  async turn(signal) {
    signal.throwIfAborted();
    if (this.free > 0) return void --this.free;
    await new Promise((go, fail) => {
      this.waiting.push(go);
      signal.addEventListener('abort', () => {
        this.waiting = this.waiting.filter((each) => each !== go);
        fail(signal.reason);
      });
    });
  }

  // `words` is a function of a private folder, called when the run begins: it gives the words of the command line.
  // Returns {code, output, report, picture}; rejects with the reason of `signal`.
  async run(program, words, {signal, progress}) {
    await this.turn(signal);
    const folder = mkdtempSync(path.join(os.tmpdir(), 'meshrepair-mcp-'));
    try {
      const file = (name) => path.join(folder, name);
      const done = await this.ended(program, [...words(file), ...this.limits, '--report', file('report.json')], {signal, progress});
      signal.throwIfAborted();
      const [report, picture] = ['report.json', 'picture.png'].map((name) => (existsSync(file(name)) ? readFileSync(file(name)) : null));
      return {...done, report: report && JSON.parse(report), picture: picture?.toString('base64')};
    } finally {
      rmSync(folder, {recursive: true, force: true});
      if (this.waiting.length > 0) this.waiting.shift()();
      else ++this.free;
    }
  }

  ended(program, words, {signal, progress}) {
    const [command, ...first] = commandOf(program);
    return new Promise((done, fail) => {
      const stdio = ['ignore', 'pipe', 'pipe', progress ? 'pipe' : 'ignore'];
      const child = spawn(command, [...first, ...words, ...(progress ? ['--progress-fd', '3'] : [])], {stdio, windowsHide: true});
      const [out, err] = [collected(child.stdout), collected(child.stderr)];
      if (progress) watch(child.stdio[3], progress);
      const cancel = () => stop(child);
      signal.addEventListener('abort', cancel);
      const late = setTimeout(cancel, 1000 * this.timeLimit + MILLISECONDS_BEYOND_LIMIT).unref();
      child.on('error', fail);
      child.on('close', (code) => {
        clearTimeout(late);
        signal.removeEventListener('abort', cancel);
        done({code, output: (out.text + err.text).trim().slice(0, MOST_OUTPUT)});
      });
    });
  }
}
