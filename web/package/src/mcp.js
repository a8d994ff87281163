// SPDX-License-Identifier: MIT
// `meshrepair mcp FOLDER...`: a server of the Model Context Protocol, with which assistants check and repair meshes of these folders.
// JSON-RPC 2.0, a message in each line of standard input and output.
import {readFileSync} from 'node:fs';
import os from 'node:os';
import {parseArgs} from 'node:util';
import {Folders} from './mcp-folders.js';
import {Runs} from './mcp-runs.js';
import {TOOLS, call, complaint} from './mcp-tools.js';

const VERSIONS = ['2025-06-18', '2025-03-26', '2024-11-05'];  // the newest first
const VERSION_OF_BATCHES = '2025-03-26';  // no other has them
const MOST_BYTES_OF_A_LINE = 4 << 20;
const MOST_IN_A_BATCH = 100;
const EXIT_USAGE = 2;
const [PARSE_ERROR, INVALID_REQUEST, NO_SUCH_METHOD, INVALID_PARAMS, INTERNAL] = [-32700, -32600, -32601, -32602, -32603];

const USAGE = `Usage: meshrepair mcp [OPTIONS] FOLDER...

Serves the Model Context Protocol on standard input and output: an assistant
can list, check, repair, combine, compare and show meshes in these folders, and
reaches no other files. A mesh that is named mcp is ./mcp.

  --time-limit SECONDS   of each call; default 300
  --max-memory SIZE      of each call, such as 2G
  --max-file SIZE        largest input; default 512M
  --jobs N               calls at a time, others wait; default 2
  -h, --help             print this help and exit

The environment variable MESHREPAIR_PROGRAMS names a folder of native programs
to use instead of those of the package: they are faster.

Examples:
  npx meshrepair mcp ~/meshes
  npx meshrepair mcp --time-limit 60 --max-memory 2G parts scans
  claude mcp add meshrepair -- npx -y meshrepair mcp ~/meshes

Exit codes: 0 standard input ended, 2 the command line is wrong,
129, 130, 143 a signal.
`;

class ProtocolError extends Error {
  constructor(code, message) {
    super(message);
    this.code = code;
  }
}

const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);
const isId = (value) => typeof value === 'string' || Number.isFinite(value);
const failure = (id, code, message) => ({jsonrpc: '2.0', id, error: {code, message}});

class Server {
  constructor(send, settings) {
    Object.assign(this, {send, settings});
    this.version = null;  // of the protocol, once it is agreed upon
    this.running = new Map();  // an AbortController for each id
  }

  // A line of the client.
  async take(line) {
    let message;
    try {
      message = JSON.parse(new TextDecoder('utf-8', {fatal: true}).decode(line));
    } catch {
      return this.send(failure(null, PARSE_ERROR, 'this line is no JSON'));
    }
    const said = Array.isArray(message) ? await this.batch(message) : await this.one(message);
    if (said) this.send(said);
  }

  async batch(messages) {
    const refused = (message) => failure(null, INVALID_REQUEST, message);
    if (this.version !== VERSION_OF_BATCHES) return refused('this version of the protocol has no batches');
    if (messages.length === 0 || messages.length > MOST_IN_A_BATCH) return refused(`a batch has 1 to ${MOST_IN_A_BATCH} messages`);
    const said = (await Promise.all(messages.map((each) => this.one(each)))).filter(Boolean);
    return said.length > 0 ? said : null;
  }

  // The answer to a message; null: it needs none.
  async one(message) {
    if (!isObject(message) || message.jsonrpc !== '2.0') return failure(null, INVALID_REQUEST, 'this is no message of JSON-RPC 2.0');
    const {id, method, params = {}} = message;
    if (method === undefined && ('result' in message || 'error' in message)) return null;
    if (typeof method !== 'string' || ('id' in message && !isId(id))) {
      return failure(isId(id) ? id : null, INVALID_REQUEST, 'a request has a method, and an id that is a string or a number');
    }
    if (id === undefined) return this.notified(method, params);
    if (this.running.has(id)) return failure(id, INVALID_REQUEST, 'a request with this id is running');
    const controller = new AbortController();
    this.running.set(id, controller);
    try {
      if (!isObject(params)) throw new ProtocolError(INVALID_PARAMS, 'params must be an object');
      return {jsonrpc: '2.0', id, result: await this.result(method, params, controller.signal)};
    } catch (error) {
      if (controller.signal.aborted) return null;
      if (error instanceof ProtocolError) return failure(id, error.code, error.message);
      process.stderr.write(`meshrepair mcp: ${error.stack}\n`);
      return failure(id, INTERNAL, error.message);
    } finally {
      this.running.delete(id);
    }
  }

  notified(method, params) {
    if (method === 'notifications/cancelled' && isObject(params)) this.running.get(params.requestId)?.abort();
    return null;
  }

  result(method, params, signal) {
    if (method === 'ping') return {};
    if (method === 'initialize') return this.initialized(params);
    if (this.version === null) throw new ProtocolError(INVALID_REQUEST, 'initialize comes first');
    if (method === 'tools/list') return {tools: TOOLS.map(({program, done, words, ...told}) => told)};
    if (method === 'tools/call') return this.called(params, signal);
    throw new ProtocolError(NO_SUCH_METHOD, `there is no method ${method}`);
  }

  initialized({protocolVersion}) {
    if (this.version !== null) throw new ProtocolError(INVALID_REQUEST, 'the session is initialized');
    if (typeof protocolVersion !== 'string') throw new ProtocolError(INVALID_PARAMS, 'protocolVersion is missing');
    this.version = VERSIONS.includes(protocolVersion) ? protocolVersion : VERSIONS[0];
    const {version} = JSON.parse(readFileSync(new URL('./package.json', import.meta.url), 'utf8'));
    return {
      protocolVersion: this.version,
      capabilities: {tools: {}},
      serverInfo: {name: 'meshrepair', title: 'meshrepair', version},
      instructions: `Meshes are files in these folders: ${this.settings.folders.folders.join(', ')}. Relative paths refer to the first. ` +
          'check a mesh, repair it to a new file, and show both with picture. Read the warnings: they say what may not be as meant.',
    };
  }

  async called({name, arguments: from = {}, _meta: meta}, signal) {
    const tool = TOOLS.find((each) => each.name === name);
    if (!tool) throw new ProtocolError(INVALID_PARAMS, `there is no tool ${name}`);
    const wrong = complaint(from, tool.inputSchema, 'arguments');
    if (wrong) throw new ProtocolError(INVALID_PARAMS, `${name}: ${wrong}`);
    const token = meta?.progressToken;
    const progress = isId(token) && ((value, message) =>
      this.send({jsonrpc: '2.0', method: 'notifications/progress', params: {progressToken: token, progress: value, message}}));
    const {structuredContent, ...result} = await call(tool, from, {...this.settings, signal, progress});
    return this.version >= '2025-06-18' && structuredContent ? {...result, structuredContent} : result;
  }

  tooLong() {
    this.send(failure(null, PARSE_ERROR, `a line has more than ${MOST_BYTES_OF_A_LINE} bytes`));
  }

  cancelAll() {
    for (const controller of this.running.values()) controller.abort();
  }
}

// Calls `take` with each line; `tooLong` instead where it is longer than can be meant.
function readLines(stream, take, tooLong) {
  let parts = [];
  let length = 0;
  const add = (bytes) => {
    length += bytes.length;
    if (length > MOST_BYTES_OF_A_LINE) parts = [];
    else parts.push(bytes);
  };
  stream.on('data', (chunk) => {
    let from = 0;
    for (let at; (at = chunk.indexOf(10, from)) >= 0; from = at + 1) {
      add(chunk.subarray(from, at));
      const line = Buffer.concat(parts);
      if (length > MOST_BYTES_OF_A_LINE) tooLong();
      else if (line.some((byte) => byte > 32)) take(line);
      [parts, length] = [[], 0];
    }
    add(chunk.subarray(from));
  });
}

function bytesOf(size, name) {
  const [, number, unit] = /^(\d+(?:\.\d+)?)([KMGT]?)$/.exec(size) ?? [];
  if (!(number > 0)) throw new Error(`--${name} ${size}: is no size, such as 512M`);
  return Number(number) * 1024 ** ' KMGT'.indexOf(unit || ' ');
}

function settingsOf(words) {
  const one = (value) => ({type: 'string', default: value});
  const {values, positionals} = parseArgs({
    args: words, allowPositionals: true,
    options: {
      'time-limit': one('300'), 'max-memory': one(''), 'max-file': one('512M'), jobs: one('2'), help: {type: 'boolean', short: 'h'},
    },
  });
  if (values.help) return {help: true};
  const timeLimit = Number(values['time-limit']);
  if (!(timeLimit > 0 && timeLimit <= 1e6)) throw new Error(`--time-limit ${values['time-limit']}: is no time in seconds`);
  if (values['max-memory']) bytesOf(values['max-memory'], 'max-memory');
  if (!/^[1-9]\d{0,2}$/.test(values.jobs)) throw new Error(`--jobs ${values.jobs}: is no number from 1 to 999`);
  if (positionals.length === 0) throw new Error('FOLDER is missing');
  const maxFile = bytesOf(values['max-file'], 'max-file');
  const runs = new Runs({jobs: Number(values.jobs), timeLimit, maxMemory: values['max-memory']});
  return {runs, folders: new Folders(positionals), maxFile};
}

export function serve(words) {
  let settings;
  try {
    settings = settingsOf(words);
  } catch (error) {
    const isPath = error.path !== undefined;
    const said = isPath ? `${error.path}: is no folder that can be read; a mesh named mcp is ./mcp` : error.message.split('\n')[0];
    process.stderr.write(`meshrepair mcp: ${said} (try 'meshrepair mcp --help')\n`);
    process.exitCode = EXIT_USAGE;
    return;
  }
  if (settings.help) process.stdout.write(USAGE);
  else listen(new Server((message) => process.stdout.write(`${JSON.stringify(message)}\n`), settings));
}

// Until standard input ends, or a signal comes.
function listen(server) {
  const working = new Set();
  let ending = false;
  const end = async (finish) => {
    if (ending) return;
    ending = true;
    server.cancelAll();
    await Promise.allSettled(working);  // no program outlives the server
    finish();
  };
  readLines(process.stdin, (line) => {
    if (ending) return;
    const work = server.take(line).finally(() => working.delete(work));
    working.add(work);
  }, () => server.tooLong());
  for (const event of ['end', 'error']) process.stdin.on(event, () => end(() => process.exit(0)));
  process.stdout.on('error', () => end(() => process.exit(0)));
  for (const signal of ['SIGHUP', 'SIGINT', 'SIGTERM']) {
    process.on(signal, () => end(() => process.exit(128 + os.constants.signals[signal])));
  }
}
