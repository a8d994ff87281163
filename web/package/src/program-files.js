// SPDX-License-Identifier: MIT
// Files of node in place of those in memory that the module has of itself: the functions of emscripten's FS that its system calls use.
// Numbers of errors and flags are those of the module's C library, descriptors are those of node. Emscripten's own
// NODERAWFS is settled when a module is linked, and this one is for pages, too.
import fs from 'node:fs';
import {isatty} from 'node:tty';
import {receiveMessageOnPort} from 'node:worker_threads';
import {fromSystem, toSystem} from './program-paths.js';

const ERRORS = {
  EACCES: 2, EAGAIN: 6, EBADF: 8, EBUSY: 10, EDQUOT: 19, EEXIST: 20, EFBIG: 22, EINTR: 27, EINVAL: 28, EIO: 29, EISDIR: 31, ELOOP: 32,
  EMFILE: 33, EMLINK: 34, ENAMETOOLONG: 37, ENFILE: 41, ENODEV: 43, ENOENT: 44, ENOMEM: 48, ENOSPC: 51, ENOSYS: 52, ENOTDIR: 54,
  ENOTEMPTY: 55, ENOTSUP: 138, ENOTTY: 59, ENXIO: 60, EPERM: 63, EPIPE: 64, EROFS: 69, ESPIPE: 70, ETXTBSY: 74, EXDEV: 75,
};
const O_CREAT = 0o100, O_EXCL = 0o200, O_DIRECTORY = 0o200000;
const FLAGS = {O_WRONLY: 1, O_RDWR: 2, O_CREAT, O_EXCL, O_NOCTTY: 0o400, O_TRUNC: 0o1000, O_APPEND: 0o2000, O_NOFOLLOW: 0o400000};
const MOST_AT_ONCE = 1 << 30;
const MILLISECONDS_OF_A_LOOK = 100;  // as posix_files.cpp
const MILLISECONDS_OF_A_PAUSE = 5;

const flagsOfNode = (flags) =>
  Object.entries(FLAGS).reduce((all, [name, bit]) => (flags & bit ? all | (fs.constants[name] ?? 0) : all), 0);
const bytesOf = (buffer, offset, length) => new Uint8Array(buffer.buffer, offset >>> 0, Math.min(length >>> 0, MOST_AT_ONCE));

function failure(code) {
  return Object.assign(new Error(code), {code});
}

// Standard input that is a pipe or a terminal: the main thread reads it.
class Pipe {
  constructor(port, shared) {
    this.port = port;
    this.shared = shared;
    this.bytes = new Uint8Array();
    this.isAsked = false;
    this.end = null;  // {} or {error}
  }

  // Whether a read would not wait. Waits for that, but not for long.
  isReady() {
    if (this.bytes.length > 0 || this.end) return true;
    if (!this.isAsked) this.port.postMessage({input: true});
    this.isAsked = true;
    const seen = Atomics.load(this.shared, 1);
    if (!this.take()) Atomics.wait(this.shared, 1, seen, MILLISECONDS_OF_A_LOOK);
    return this.take();
  }

  take() {
    if (this.bytes.length > 0 || this.end) return true;
    const message = receiveMessageOnPort(this.port)?.message;
    if (!message) return false;
    this.isAsked = false;
    if (message.bytes) this.bytes = message.bytes;
    else this.end = message;
    return true;
  }

  read(target) {
    while (!this.isReady()) {
      if (Atomics.load(this.shared, 0) !== 0) throw failure('EINTR');
    }
    if (this.end?.error) throw failure(this.end.error);
    const some = this.bytes.subarray(0, target.length);
    target.set(some);
    this.bytes = this.bytes.subarray(some.length);
    return some.length;
  }
}

class Stream {
  constructor(fd, path, flags, status) {
    this.fd = fd;
    this.flags = flags;
    this.tty = isatty(fd);
    this.path = status.isDirectory() && path ? path : fd;  // what stat() and readdir() get
    this.node = {id: status.ino, mode: status.mode, path};
    this.seekable = status.isFile() && path !== null;  // those of others stand where they stand
    this.position = 0;
    this.stream_ops = {fsync: () => (fs.fsyncSync(fd), 0)};
  }

  at(position) {
    return this.seekable ? position ?? this.position : null;
  }

  moveOn(position, count) {
    if (position === undefined) this.position += count;
    return count;
  }
}

// Who made a pipe may have made it one that does not wait.
function writePatiently(fd, bytes, position, shared) {
  for (;;) {
    try {
      return fs.writeSync(fd, bytes, 0, bytes.length, position);
    } catch (error) {
      if (error.code !== 'EAGAIN') throw error;
      if (Atomics.load(shared, 0) !== 0) throw failure('EINTR');
      Atomics.wait(shared, 0, 0, MILLISECONDS_OF_A_PAUSE);
    }
  }
}

function nodeAt(path) {
  const status = fs.lstatSync(toSystem(path));
  return {id: status.ino, mode: status.mode, path};
}

// `port` leads to the main thread, which removes an unfinished file if the program is ended by force.
function functions(FS, port, shared) {
  const input = new Pipe(port, shared);
  let unfinished = null;
  const noteUnfinished = (path) => {
    unfinished = path;
    port.postMessage({unfinished: path});
  };
  const noteGone = (path) => {
    if (path === unfinished) noteUnfinished(null);
  };

  function statusOf(path) {
    return typeof path === 'number' ? fs.fstatSync(path) : fs.statSync(toSystem(path));
  }

  // A descriptor that the process was started with; not what node waits with, which has no type.
  function adopted(fd) {
    try {
      const status = fs.fstatSync(fd);
      const isOurs = status.isFile() || status.isDirectory() || status.isFIFO() || status.isSocket() || status.isCharacterDevice();
      return isOurs ? new Stream(fd, null, 2, status) : undefined;
    } catch {
      return undefined;
    }
  }

  return {
    getStream: (fd) => FS.streams[fd] ?? (fd >= 0 ? (FS.streams[fd] = adopted(fd)) : undefined),
    cwd: () => fromSystem(process.cwd()),
    chdir: (path) => process.chdir(toSystem(path)),
    stat: statusOf,
    lstat: (path) => fs.lstatSync(toSystem(path)),
    lookupPath: (path, {parent = false} = {}) => {
      const of = parent ? path.replace(/\/[^/]*\/?$/, '') || '/' : path;
      return {path: of, node: nodeAt(of)};
    },
    lookupNode: (folder, name) => nodeAt(`${folder.path}/${name}`),
    nodePermissions: ({path}, letters) => {
      const bits = {r: fs.constants.R_OK, w: fs.constants.W_OK, x: fs.constants.X_OK};
      fs.accessSync(toSystem(path), [...letters].reduce((all, letter) => all | bits[letter], 0));
      return 0;
    },
    open: (path, flags, mode) => {
      const name = toSystem(path);
      const isOwn = (flags & O_CREAT) !== 0 && (flags & O_EXCL) !== 0;
      if (isOwn) noteUnfinished(name);
      let fd = -1;
      try {
        fd = fs.openSync(name, flagsOfNode(flags), mode & 0o7777);
        const status = fs.fstatSync(fd);
        if ((flags & O_DIRECTORY) !== 0 && !status.isDirectory()) throw failure('ENOTDIR');
        return (FS.streams[fd] = new Stream(fd, path, flags, status));
      } catch (error) {
        if (fd >= 0) fs.closeSync(fd);
        if (isOwn) noteUnfinished(null);
        throw error;
      }
    },
    close: (stream) => {
      FS.streams[stream.fd] = undefined;
      fs.closeSync(stream.fd);
    },
    read: (stream, buffer, offset, length, position) => {
      const bytes = bytesOf(buffer, offset, length);
      if (stream.fd === 0 && !stream.isFile) return input.read(bytes);
      return stream.moveOn(position, fs.readSync(stream.fd, bytes, 0, bytes.length, stream.at(position)));
    },
    write: (stream, buffer, offset, length, position) => {
      const bytes = bytesOf(buffer, offset, length);
      return stream.moveOn(position, writePatiently(stream.fd, bytes, stream.at(position), shared));
    },
    llseek: (stream, offset, whence) => {
      if (!stream.seekable && !FS.isDir(stream.node.mode)) throw failure('ESPIPE');
      const from = [0, stream.position, whence === 2 ? fs.fstatSync(stream.fd).size : 0][whence];
      if (!(from + offset >= 0)) throw failure('EINVAL');
      return (stream.position = from + offset);
    },
    readdir: (path) => ['.', '..', ...fs.readdirSync(toSystem(path))],
    readlink: (path) => fromSystem(fs.readlinkSync(toSystem(path))),
    rename: (from, to) => {
      fs.renameSync(toSystem(from), toSystem(to));
      noteGone(toSystem(from));
    },
    unlink: (path) => {
      fs.unlinkSync(toSystem(path));
      noteGone(toSystem(path));
    },
    mkdir: (path, mode) => fs.mkdirSync(toSystem(path), mode),
    rmdir: (path) => fs.rmdirSync(toSystem(path)),
    symlink: (target, path) => fs.symlinkSync(toSystem(target), toSystem(path)),
    chmod: (path, mode) => fs.chmodSync(toSystem(path), mode),
    fchmod: (fd, mode) => fs.fchmodSync(fd, mode & 0o7777),
    chown: (path, user, group) => fs.chownSync(toSystem(path), user, group),
    fchown: (fd, user, group) => fs.fchownSync(fd, user, group),
    truncate: (path, bytes) => fs.truncateSync(toSystem(path), bytes),
    ftruncate: (fd, bytes) => fs.ftruncateSync(fd, bytes),
    utime: (path, accessed, changed) => fs.utimesSync(toSystem(path), accessed / 1000, changed / 1000),
    input,
  };
}

// An error of node is one of C.
function translated(FS, call) {
  return (...values) => {
    try {
      return call(...values);
    } catch (error) {
      if (!error?.code) throw error;
      throw new FS.ErrnoError(ERRORS[error.code] ?? ERRORS.EIO);
    }
  };
}

export function useFilesOfNode(FS, port, shared) {
  const {input, ...calls} = functions(FS, port, shared);
  for (const [name, call] of Object.entries(calls)) FS[name] = translated(FS, call);
  FS.streams = [];
  for (const fd of [0, 1, 2]) FS.getStream(fd);
  const standard = FS.streams[0];
  if (!standard) return;
  standard.isFile = FS.isFile(standard.node.mode);
  if (!standard.isFile) standard.stream_ops.poll = () => (input.isReady() ? 5 : 0);  // POLLIN and POLLOUT
}
